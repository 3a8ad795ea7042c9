// Lambert's cosine law: colour = ambient Kd + sum over lights of light * Kd * max(n.l, 0).
// Lambert 1760, [Compendium 11.1], [Course 6], [Primer 7]. No 1/pi, as MTL means it.
#include "shade/stage.h"

#define SIMD_FILE "shade/reflection/lambert.cpp"
#include "simd/for_each_target.h"

#include "shade/reflection/diffuse-inl.h"

SIMD_BEGIN(scanout::shade::reflection)

void lambert_run(ShadingBlock& b, const FrameState& frame) {
    diffuse(b, frame);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::reflection {

SIMD_REGISTER(lambert_run);

extern const ReflectionStage lambert;
constinit const ReflectionStage lambert{
    {{.axis = "reflection",
      .name = "lambert",
      .blurb = "matt: light by the cosine of its angle",
      .source = "Lambert 1760",
      .kind = Kind::model},
     Pass::called,
     {.normal = true},
     [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(lambert_run, block, frame); }},
    {.highlight = false}};

} // namespace scanout::shade::reflection
#endif
