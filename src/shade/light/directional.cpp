// A directional light, so far away that its rays are parallel: the same direction and colour
// everywhere. It is written to the lanes only where a shadow makes it vary. [Compendium 11.1],
// [Primer 7].
#include "shade/stage.h"

#define SIMD_FILE "shade/light/directional.cpp"
#include "simd/for_each_target.h"

#include "shade/light/write-inl.h"

SIMD_BEGIN(scanout::shade::light)

void directional_run(ShadingBlock& b, const FrameState& frame) {
    for_each_lane(
        b, frame, scene::LightKind::directional,
        [&](const scene::ViewLight& light, BlockLight& lanes, int i) SIMD_LAMBDA {
            store_arrival({everywhere<Vec3F32>(light.towards), F32(1.0F)}, light, lanes, i);
        });
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::light {

SIMD_REGISTER(directional_run);

extern const LightStage directional;
constinit const LightStage directional{{{.axis = "light",
                                         .name = "directional",
                                         .blurb = "parallel rays, from the world or the camera",
                                         .source = "Foley et al. 1990, ch. 16",
                                         .kind = Kind::effect},
                                        Pass::light,
                                        {},
                                        [](ShadingBlock& block, const FrameState& frame) {
                                            SIMD_CALL(directional_run, block, frame);
                                        }},
                                       {scene::LightKind::directional}};

} // namespace scanout::shade::light
#endif
