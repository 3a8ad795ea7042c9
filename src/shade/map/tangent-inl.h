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

#include "shade/lane_triangles.h"

#include "simd/entries-inl.h"

SIMD_BEGIN(scanout::shade::map)

template <class D>
struct Vector {
    Float<D> x, y, z;

    friend SIMD_INLINE Vector operator+(const Vector& a, const Vector& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend SIMD_INLINE Vector operator-(const Vector& a, const Vector& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend SIMD_INLINE Vector operator*(const Vector& a, Float<D> s) {
        return {a.x * s, a.y * s, a.z * s};
    }
};
template <class D>
SIMD_INLINE Float<D> dot(const Vector<D>& a, const Vector<D>& b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <class D>
SIMD_INLINE Vector<D> cross(const Vector<D>& a, const Vector<D>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class D>
SIMD_INLINE Vector<D> select(Mask<D> mask, const Vector<D>& yes, const Vector<D>& no) {
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}
using Vector8 = Vector<F32x8::Tag>;
using VectorN = Vector<F32::Tag>;

template <class V>
SIMD_INLINE V load_vector(const float (&from)[3][kPaddedBlock], int lane) {
    using F = decltype(V::x);
    return {load<F>(from[0] + lane), load<F>(from[1] + lane), load<F>(from[2] + lane)};
}
template <class V>
SIMD_INLINE void store_vector(const V& v, float (&to)[3][kPaddedBlock], int lane) {
    store(v.x, to[0] + lane);
    store(v.y, to[1] + lane);
    store(v.z, to[2] + lane);
}

// How the surface's point moves, in view space, from a pixel to the next one to the right and the
// next one down, but for a common factor. plane: the triangle's normal; ray: to the point.
struct Steps {
    Vector8 right, down;
};
SIMD_INLINE Steps steps_on(const Vector8& plane, const Vector8& ray, bool orthographic) {
    const F32x8 zero = 0.0F, one = 1.0F;
    const Vector8 along = orthographic ? Vector8{zero, zero, -one} : ray;
    const F32x8 facing = dot(plane, along);
    // Seen edge on there is no step to speak of; the frame below is then unusable.
    const F32x8 inverse = one / select(abs(facing) > F32x8(0x1p-60F), facing, one);
    return {Vector8{one, zero, zero} - along * (plane.x * inverse),
            Vector8{zero, -one, zero} + along * (plane.y * inverse)};
}

// Writes b.tangent: unit vectors in view space along growing u and v, at right angles to the
// shading normal and to each other; turned as u and v are, mirrored or not.
SIMD_INLINE void write_tangents(Block& b, const FrameState& frame) {
    const F32x8 zero = 0.0F, one = 1.0F;
    for (const Run* run = b.run; run != b.run + b.runs; ++run) {
        for (int i = run->first; i < run->first + run->count; i += kLanesX8) {
            const auto facing = [&](int c) SIMD_LAMBDA {
                if (run->primitive != nullptr) return F32x8(run->primitive->facing[c]);
                const LaneTriangles& t = *b.triangles;
                return Entries<F32x8::Tag>(t.of_lane + i, run->first + run->count - i)
                    .of(t.facing[c]);
            };
            const F32x8 f[3] = {facing(0), facing(1), facing(2)};
            const auto row = [&](int r) SIMD_LAMBDA {
                const auto& m = frame.normal_matrix[r];
                return (F32x8(m[0]) * f[0] + F32x8(m[1]) * f[1]) + F32x8(m[2]) * f[2];
            };
            const Vector8 plane = {row(0), row(1), row(2)};
            const Vector8 ray = {load<F32x8>(b.ray_x + i), load<F32x8>(b.ray_y + i), -one};
            const Steps step = steps_on(plane, ray, frame.orthographic);
            const F32x8 u_x = load<F32x8>(b.u_x + i), v_x = load<F32x8>(b.v_x + i),
                        u_y = load<F32x8>(b.u_y + i), v_y = load<F32x8>(b.v_y + i);
            const F32x8 turned = select(u_x * v_y - u_y * v_x < zero, -one, one);
            const Vector8 along_u = (step.right * v_y - step.down * v_x) * turned;
            const Vector8 along_v = (step.down * u_x - step.right * u_y) * turned;
            const Vector8 normal = load_vector<Vector8>(b.normal, i);
            // Duff et al.
            const F32x8 sign = select(normal.z < zero, -one, one);
            const F32x8 a = -one / (sign + normal.z), c = normal.x * normal.y * a;
            const Vector8 any_u = {one + sign * normal.x * normal.x * a, sign * c,
                                   -(sign * normal.x)};
            const Vector8 flat = along_u - normal * dot(normal, along_u);
            const F32x8 size = sqrt(dot(flat, flat));
            const auto usable = (size > F32x8(0x1p-40F)) & (size < F32x8(0x1p60F));
            const Vector8 u = select(usable, flat * (one / select(usable, size, one)), any_u);
            const Vector8 v = cross(normal, u);
            const auto mirrored = usable & (dot(v, along_v) < zero);
            store_vector(u, b.tangent[0], i);
            store_vector(select(mirrored, v * -one, v), b.tangent[1], i);
        }
    }
}

// The normal whose components along b.tangent and b.normal are given; of any length. Where it does
// not lean, the normal stays as it is, to the bit.
SIMD_INLINE void lean_normal(Block& b, int lane, const VectorN& given) {
    const F32 zero = 0.0F, one = 1.0F;
    const VectorN normal = load_vector<VectorN>(b.normal, lane);
    const VectorN leant = (load_vector<VectorN>(b.tangent[0], lane) * given.x +
                           load_vector<VectorN>(b.tangent[1], lane) * given.y) +
                          normal * given.z;
    const F32 length = sqrt(dot(leant, leant));
    const auto straight = (given.x == zero) & (given.y == zero);
    const auto usable = (length > F32(0x1p-20F)) & !straight;
    const F32 scale = one / select(usable, length, one);
    store_vector(select(usable, leant * scale, normal), b.normal, lane);
}

SIMD_END

#endif
