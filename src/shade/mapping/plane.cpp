// Plane mapping, like a slide projected onto the model from the front: u along x, v along y. Bier
// and Sloan 1986, [Primer 9.4].
#include "shade/stage.h"

#define SIMD_FILE "shade/mapping/plane.cpp"
#include "simd/for_each_target.h"

#include "shade/mapping/project-inl.h"

SIMD_BEGIN(scanout::shade::mapping)

void plane_run(ShadingBlock& b, const FrameState& frame) {
    project_lanes(b, frame, [](const Primitive&, const Place& p) SIMD_LAMBDA {
        const F32x8 half = 0.5F, zero = 0.0F;
        return Projected{
            half + p.x * half, half + p.y * half, {half, zero, zero}, {zero, half, zero}};
    });
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::mapping {

SIMD_REGISTER(plane_run);

extern const Stage plane;
constinit const Stage plane{{.axis = "mapping",
                             .name = "plane",
                             .blurb = "thrown on from the front",
                             .source = "Bier and Sloan 1986",
                             .kind = Kind::model},
                            Pass::mapping,
                            {.uv = true, .object = true},
                            [](ShadingBlock& block, const FrameState& frame) {
                                if (wants_uv(block, frame)) SIMD_CALL(plane_run, block, frame);
                            }};

} // namespace scanout::shade::mapping
#endif
