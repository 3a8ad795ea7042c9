// A point light: the light that arrives falls off with the square of the distance. Lambert 1760,
// [Primer 7].
#include "shade/stage.h"

#define SIMD_FILE "shade/light/point.cpp"
#include "simd/for_each_target.h"

#include "shade/light/write-inl.h"

SIMD_BEGIN(scanout::shade::light)

void point_run(ShadingBlock& b, const FrameState& frame) {
    for_each_lane(b, frame, scene::LightKind::point,
                  [&](const scene::ViewLight& light, BlockLight& lanes, int i)
                      SIMD_LAMBDA { store_arrival(arrival(b, light, i), light, lanes, i); });
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::light {

SIMD_REGISTER(point_run);

extern const LightStage point;
constinit const LightStage point{
    {{.axis = "light",
      .name = "point",
      .blurb = "a place that shines by the inverse square of the distance",
      .source = "Lambert 1760; Foley et al. 1990, ch. 16",
      .kind = Kind::effect},
     Pass::light,
     {.position = true},
     [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(point_run, block, frame); }},
    {scene::LightKind::point}};

} // namespace scanout::shade::light
#endif
