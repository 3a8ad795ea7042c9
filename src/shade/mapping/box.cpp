// Box mapping, like paper on a box: each triangle takes the side that it faces most, so that
// nothing is stretched by more than the root of three. Bier and Sloan 1986, [Primer 9.4].
#include "shade/stage.h"

#define SIMD_FILE "shade/mapping/box.cpp"
#include "simd/for_each_target.h"

#include "shade/mapping/project-inl.h"

SIMD_BEGIN(scanout::shade::mapping)

void box_run(ShadingBlock& b, const FrameState& frame) {
    project_lanes(b, frame, [](const Primitive& t, const Place& p) SIMD_LAMBDA {
        const auto size = [&](int axis) SIMD_LAMBDA { // of the normal along an axis
            return t.facing[axis] < 0 ? -t.facing[axis] : t.facing[axis];
        };
        const F32x8 half = 0.5F, zero = 0.0F;
        // The side is the one that the eye sees: no picture is mirrored.
        if (size(1) > size(0) && size(1) > size(2)) {
            const F32x8 side = t.facing[1] < 0 ? 0.5F : -0.5F;
            return Projected{
                half + p.x * half, half + p.z * side, {half, zero, zero}, {zero, zero, side}};
        }
        if (size(0) > size(2)) {
            const F32x8 side = t.facing[0] < 0 ? 0.5F : -0.5F;
            return Projected{
                half + p.z * side, half + p.y * half, {zero, zero, side}, {zero, half, zero}};
        }
        const F32x8 side = t.facing[2] < 0 ? -0.5F : 0.5F;
        return Projected{
            half + p.x * side, half + p.y * half, {side, zero, zero}, {zero, half, zero}};
    });
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::mapping {

SIMD_REGISTER(box_run);

extern const Stage box;
constinit const Stage box{{.axis = "mapping",
                           .name = "box",
                           .blurb = "from the side of a box that a triangle faces most",
                           .source = "Bier and Sloan 1986",
                           .kind = Kind::model},
                          Pass::mapping,
                          {.uv = true, .facing = true, .object = true},
                          [](ShadingBlock& block, const FrameState& frame) {
                              if (wants_uv(block, frame)) SIMD_CALL(box_run, block, frame);
                          }};

} // namespace scanout::shade::mapping
#endif
