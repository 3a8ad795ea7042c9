// Cylinder mapping, like a label around a tin: u around the y axis, v along it, over the height of
// the model's sphere. Bier and Sloan 1986, [Primer 9.4].
#include "shade/stage.h"

#define SIMD_FILE "shade/mapping/cylinder.cpp"
#include "simd/for_each_target.h"

#include "shade/mapping/project-inl.h"

SIMD_BEGIN(scanout::shade::mapping)

void cylinder_run(ShadingBlock& b, const FrameState& frame) {
    project_lanes(b, frame, [](const Primitive&, const Place& p) SIMD_LAMBDA {
        const Around around = around_y(p);
        const F32x8 half = 0.5F, zero = 0.0F;
        return Projected{around.u, half + p.y * half, around.u_by, {zero, half, zero}};
    });
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::mapping {

SIMD_REGISTER(cylinder_run);

extern const Stage cylinder;
constinit const Stage cylinder{{.axis = "mapping",
                                .name = "cylinder",
                                .blurb = "around the y axis, and along it",
                                .source = "Bier and Sloan 1986",
                                .kind = Kind::model},
                               Pass::mapping,
                               {.uv = true, .object = true},
                               [](ShadingBlock& block, const FrameState& frame) {
                                   if (wants_uv(block, frame))
                                       SIMD_CALL(cylinder_run, block, frame);
                               }};

} // namespace scanout::shade::mapping
#endif
