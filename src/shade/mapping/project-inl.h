// Mapping coordinates from positions on the model: the loop that the mappings share. Computed at
// every pixel from the exact position in the triangle's plane, so that nothing bends inside a
// triangle. The derivatives from pixel to pixel follow from the mapping's own derivatives, which
// have no seam: u may jump from 1 to 0 between two pixels, but no footprint does.
#if defined(SCANOUT_SHADE_PROJECT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_PROJECT_INL_H
#undef SCANOUT_SHADE_PROJECT_INL_H
#else
#define SCANOUT_SHADE_PROJECT_INL_H
#endif

#include "shade/setup/footprint-inl.h"
#include "simd/vec3-inl.h"

SIMD_BEGIN(scanout::shade::mapping)

// A position on the model in object space: the model's middle is the origin, its corners lie within
// 1.
using Place = Vec3F32x8;
// u and v, and their derivatives along x, y and z.
struct Projected {
    F32x8 u, v;
    Vec3F32x8 u_by, v_by;
};

// Clamps to the range of the triangle's vertices, against rounding. Also turns NaN into a number:
// the position is NaN where a sample lies so close beside a clipped triangle that all weights are
// 0.
SIMD_INLINE F32x8 within(F32x8 x, const float (&vertex)[3]) {
    const F32x8 a = vertex[0], b = vertex[1], c = vertex[2];
    return minimum(maximum(x, minimum(minimum(a, b), c)), maximum(maximum(a, b), c));
}

// project(primitive, place) returns a Projected.
template <class Project>
SIMD_INLINE void project_lanes(ShadingBlock& b, const FrameState& frame, Project project) {
    for (const Run* run = b.run; run != b.run + b.runs; ++run) {
        const Primitive& t = *run->primitive;
        const texture::HWY_NAMESPACE::PrimitivePlane<3> plane(t, t.object);
        for (int i = run->first; i < run->first + run->count; i += kLanesX8) {
            const auto at = plane.at(load<I32x8>(b.x + i), load<I32x8>(b.y + i));
            const Projected p =
                project(t, Place{within(at.value[0], t.object[0]), within(at.value[1], t.object[1]),
                                 within(at.value[2], t.object[2])});
            store(p.u, b.u + i);
            store(p.v, b.v + i);
            if (!frame.attributes.footprint) continue;
            const Vec3F32x8 right = {at.right[0], at.right[1], at.right[2]},
                            down = {at.down[0], at.down[1], at.down[2]};
            const auto bounded = [](F32x8 x) SIMD_LAMBDA {
                return minimum(maximum(x, F32x8(-0x1p60F)), F32x8(0x1p60F));
            };
            store(bounded(dot(p.u_by, right)), b.u_x + i);
            store(bounded(dot(p.v_by, right)), b.v_x + i);
            store(bounded(dot(p.u_by, down)), b.u_y + i);
            store(bounded(dot(p.v_by, down)), b.v_y + i);
        }
    }
}

// Around the y axis: 0 behind, 1/2 in front (+z), growing to the right.
struct Around {
    F32x8 u, distance; // from the axis
    Vec3F32x8 u_by;
};
SIMD_INLINE Around around_y(const Place& p) {
    constexpr float kPerTurn = 0.15915494F; // 1 / 2 pi
    const F32x8 squared = p.x * p.x + p.z * p.z;
    // On the axis itself there is no direction: its slopes are steep, but finite.
    const F32x8 scale = F32x8(kPerTurn) / maximum(squared, F32x8(0x1p-40F));
    return {F32x8(0.5F) + atan2(p.x, p.z) * F32x8(kPerTurn),
            sqrt(squared),
            {p.z * scale, F32x8(0.0F), -(p.x * scale)}};
}

SIMD_END

#endif
