// The directions in which u and v grow on the surface: what normal and bump maps are relative to.
// They follow from how u, v and the surface itself change from pixel to pixel, so that no vertex
// has to keep them, and any mapping has them: Mikkelsen 2010. Where u and v do not tell
// (HARD-CASES 31), any directions will do: Duff et al. 2017, which holds for every normal
// (HARD-CASES 30).
#if defined(SCANOUT_SHADE_TANGENT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_TANGENT_INL_H
#undef SCANOUT_SHADE_TANGENT_INL_H
#else
#define SCANOUT_SHADE_TANGENT_INL_H
#endif

#include "shade/setup/shading_setup.h"

#include "simd/entries-inl.h"
#include "simd/vec3-inl.h"

SIMD_BEGIN(scanout::shade::map)

// How the surface's point moves, in view space, from a pixel to the next one to the right and the
// next one down, but for a common factor. plane: the triangle's normal; ray: to the point.
struct Steps {
    Vec3F32x8 right, down;
};
SIMD_INLINE Steps steps_on(const Vec3F32x8& plane, const Vec3F32x8& ray, bool orthographic) {
    const F32x8 zero = 0.0F, one = 1.0F;
    const Vec3F32x8 along = orthographic ? Vec3F32x8{zero, zero, -one} : ray;
    const F32x8 facing = dot(plane, along);
    // Seen edge on there is no step to speak of; the frame below is then unusable.
    const F32x8 inverse = one / select(abs(facing) > F32x8(0x1p-60F), facing, one);
    return {Vec3F32x8{one, zero, zero} - along * (plane.x * inverse),
            Vec3F32x8{zero, -one, zero} + along * (plane.y * inverse)};
}

// Writes b.tangent: unit vectors in view space along growing u and v, at right angles to the
// shading normal and to each other; turned as u and v are, mirrored or not.
SIMD_INLINE void write_tangents(ShadingBlock& b, const FrameState& frame) {
    const F32x8 zero = 0.0F, one = 1.0F;
    for (const Run* run = b.run; run != b.run + b.runs; ++run) {
        for (int i = run->first; i < run->first + run->count; i += kLanesX8) {
            const auto facing = [&](int c) SIMD_LAMBDA {
                if (run->primitive != nullptr) return F32x8(run->primitive->facing[c]);
                const ShadingSetup& t = *b.triangles;
                return Entries<F32x8::Tag>(t.triangle_of + i, run->first + run->count - i)
                    .of(t.facing[c]);
            };
            const Vec3F32x8 plane =
                transformed(frame.normal_matrix, Vec3F32x8{facing(0), facing(1), facing(2)});
            const Vec3F32x8 ray = {load<F32x8>(b.ray_x + i), load<F32x8>(b.ray_y + i), -one};
            const Steps step = steps_on(plane, ray, frame.orthographic);
            const F32x8 u_x = load<F32x8>(b.u_x + i), v_x = load<F32x8>(b.v_x + i),
                        u_y = load<F32x8>(b.u_y + i), v_y = load<F32x8>(b.v_y + i);
            const F32x8 turned = select(u_x * v_y - u_y * v_x < zero, -one, one);
            const Vec3F32x8 along_u = (step.right * v_y - step.down * v_x) * turned;
            const Vec3F32x8 along_v = (step.down * u_x - step.right * u_y) * turned;
            const Vec3F32x8 normal = load_vec3<Vec3F32x8>(b.normal, i);
            // Duff et al.
            const F32x8 sign = select(normal.z < zero, -one, one);
            const F32x8 a = -one / (sign + normal.z), c = normal.x * normal.y * a;
            const Vec3F32x8 any_u = {one + sign * normal.x * normal.x * a, sign * c,
                                     -(sign * normal.x)};
            const Vec3F32x8 flat = along_u - normal * dot(normal, along_u);
            const F32x8 size = length(flat);
            const auto usable = (size > F32x8(0x1p-40F)) & (size < F32x8(0x1p60F));
            const Vec3F32x8 u = normalised(flat, size, usable, any_u);
            const Vec3F32x8 v = cross(normal, u);
            const auto mirrored = usable & (dot(v, along_v) < zero);
            store_vec3(u, b.tangent[0], i);
            store_vec3(select(mirrored, v * -one, v), b.tangent[1], i);
        }
    }
}

// The normal whose components along b.tangent and b.normal are given; of any length. Where it does
// not lean, the normal stays as it is, to the bit.
SIMD_INLINE void lean_normal(ShadingBlock& b, int item, const Vec3F32& given) {
    const F32 zero = 0.0F;
    const Vec3F32 normal = load_vec3<Vec3F32>(b.normal, item);
    const Vec3F32 leant = (load_vec3<Vec3F32>(b.tangent[0], item) * given.x +
                           load_vec3<Vec3F32>(b.tangent[1], item) * given.y) +
                          normal * given.z;
    const F32 size = length(leant);
    const auto straight = (given.x == zero) & (given.y == zero);
    const auto usable = (size > F32(0x1p-20F)) & !straight;
    store_vec3(normalised(leant, size, usable, normal), b.normal, item);
}

SIMD_END

#endif
