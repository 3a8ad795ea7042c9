// Sphere mapping, like a map of the world on a globe: u around the y axis, v from pole to pole.
// Bier and Sloan 1986, [Primer 9.4].
#include "shade/stage.h"

#define SIMD_FILE "shade/mapping/sphere.cpp"
#include "simd/for_each_target.h"

#include "shade/mapping/project-inl.h"

SIMD_BEGIN(scanout::shade::mapping)

void sphere_run(ShadingBlock& b, const FrameState& frame) {
    project_lanes(b, frame, [](const Primitive&, const Place& p) SIMD_LAMBDA {
        constexpr float kPerHalfTurn = 0.31830987F; // 1 / pi
        const Around around = around_y(p);
        const F32x8 d = maximum(around.distance, F32x8(0x1p-20F));
        const F32x8 scale = F32x8(kPerHalfTurn) / (d * d + p.y * p.y), tilt = -(p.y * scale) / d;
        return Projected{around.u,
                         F32x8(0.5F) + atan2(p.y, around.distance) * F32x8(kPerHalfTurn),
                         around.u_by,
                         {p.x * tilt, d * scale, p.z * tilt}};
    });
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::mapping {

SIMD_REGISTER(sphere_run);

extern const Stage sphere;
constinit const Stage sphere{{.axis = "mapping",
                              .name = "sphere",
                              .blurb = "longitude and latitude about the model's middle",
                              .source = "Bier and Sloan 1986",
                              .kind = Kind::model},
                             Pass::mapping,
                             {.uv = true, .object = true},
                             [](ShadingBlock& block, const FrameState& frame) {
                                 if (wants_uv(block, frame)) SIMD_CALL(sphere_run, block, frame);
                             }};

} // namespace scanout::shade::mapping
#endif
