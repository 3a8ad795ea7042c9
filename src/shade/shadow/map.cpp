// A hard shadow map: reads the one texel that the receiver falls into. Williams 1978, [Primer 10].
// Its parts: this kernel, and the pass that draws the map (frame/pass/shadow_maps.h).
#include "shade/stage.h"

#define SIMD_FILE "shade/shadow/map.cpp"
#include "simd/for_each_target.h"

#include "shade/shadow/map-inl.h"

SIMD_BEGIN(scanout::shade::shadow)

void map_run(ShadingBlock& b, const FrameState& frame) {
    shadow_by_maps(b, frame,
                   [](const ShadowMap& m, const Receiver& r, const LightShadow&)
                       SIMD_LAMBDA { return hidden(own_texel(m, r)); });
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::shadow {

SIMD_REGISTER(map_run);

extern const ShadowStage map;
constinit const ShadowStage map{
    {{.axis = "shadow",
      .name = "map",
      .blurb = "the depth that the light sees, one texel: hard, with steps",
      .source = "Williams 1978",
      .kind = Kind::rung},
     Pass::shadow,
     {.position = true, .facing = true},
     [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(map_run, block, frame); }},
    {.by = ShadowBy::maps}};

} // namespace scanout::shade::shadow
#endif
