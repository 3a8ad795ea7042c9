// Vectors of three lane values: a point, a direction or a linear colour in every lane. Included
// once for every target. Every result is one fixed sequence of roundings, which its function
// states, so that a kernel reads like its paper and still gives the same bits on every target.
//
//     Vec3F32, Vec3F32x8, Vec3F64    of F32, F32x8 and F64 (simd/lanes-inl.h)
#if defined(SCANOUT_SIMD_VEC3_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SIMD_VEC3_INL_H
#undef SCANOUT_SIMD_VEC3_INL_H
#else
#define SCANOUT_SIMD_VEC3_INL_H
#endif

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scanout::simd::HWY_NAMESPACE {

// T: lane values. The operators work component by component, one rounding each.
template <class T>
struct LaneVec3 {
    T x, y, z;

    friend SIMD_INLINE LaneVec3 operator+(const LaneVec3& a, const LaneVec3& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend SIMD_INLINE LaneVec3 operator-(const LaneVec3& a, const LaneVec3& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend SIMD_INLINE LaneVec3 operator*(const LaneVec3& a, const LaneVec3& b) {
        return {a.x * b.x, a.y * b.y, a.z * b.z};
    }
    friend SIMD_INLINE LaneVec3 operator*(const LaneVec3& a, T s) {
        return {a.x * s, a.y * s, a.z * s};
    }
    friend SIMD_INLINE LaneVec3 abs(const LaneVec3& a) { return {abs(a.x), abs(a.y), abs(a.z)}; }
};
using Vec3F32 = LaneVec3<F32>;
using Vec3F32x8 = LaneVec3<F32x8>;
using Vec3F64 = LaneVec3<F64>;

// The same in all components.
template <class T>
SIMD_INLINE LaneVec3<T> splat(T a) {
    return {a, a, a};
}

// (x x' + y y') + z z': five roundings.
template <class T>
SIMD_INLINE T dot(const LaneVec3<T>& a, const LaneVec3<T>& b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
// (x^2 + y^2) + z^2: five roundings.
template <class T>
SIMD_INLINE T length_squared(const LaneVec3<T>& a) {
    return dot(a, a);
}
// The root of length_squared: six roundings.
template <class T>
SIMD_INLINE T length(const LaneVec3<T>& a) {
    return sqrt(length_squared(a));
}
// y z' - z y', z x' - x z', x y' - y x': three roundings a component.
template <class T>
SIMD_INLINE LaneVec3<T> cross(const LaneVec3<T>& a, const LaneVec3<T>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class M, class T>
SIMD_INLINE LaneVec3<T> select(M mask, const LaneVec3<T>& yes, const LaneVec3<T>& no) {
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}
// a (1 / length), of which the inverse is rounded before the product; `otherwise` where `usable`
// says that the length is too near to 0, or to infinity, to divide by.
template <class T, class M>
SIMD_INLINE LaneVec3<T> normalised(const LaneVec3<T>& a, T length, M usable,
                                   const LaneVec3<T>& otherwise) {
    return select(usable, a * (T(1) / select(usable, length, T(1))), otherwise);
}
// The greatest component: the maximum of x and y, then of that and z.
template <class T>
SIMD_INLINE T greatest(const LaneVec3<T>& a) {
    return maximum(maximum(a.x, a.y), a.z);
}
// The same in all lanes, from three numbers in a row, or x, y and z of a plain vector.
template <class V, class Number>
SIMD_INLINE V everywhere(const Number (&from)[3]) {
    using T = decltype(V::x);
    using Lane = hn::TFromD<typename T::Tag>;
    return {T(static_cast<Lane>(from[0])), T(static_cast<Lane>(from[1])),
            T(static_cast<Lane>(from[2]))};
}
template <class V, class Plain>
SIMD_INLINE V everywhere(const Plain& from) {
    using T = decltype(V::x);
    using Lane = hn::TFromD<typename T::Tag>;
    return {T(static_cast<Lane>(from.x)), T(static_cast<Lane>(from.y)),
            T(static_cast<Lane>(from.z))};
}
// A matrix of three rows times a column: the dot product of each row with it, five roundings each.
template <class T, class Number>
SIMD_INLINE LaneVec3<T> transformed(const Number (&rows)[3][3], const LaneVec3<T>& a) {
    using V = LaneVec3<T>;
    return {dot(everywhere<V>(rows[0]), a), dot(everywhere<V>(rows[1]), a),
            dot(everywhere<V>(rows[2]), a)};
}

// Loads from and stores to a structure of arrays, beginning at a lane.
template <class V, std::size_t kCount>
SIMD_INLINE V load_vec3(const float (&from)[3][kCount], int lane) {
    using T = decltype(V::x);
    return {load<T>(from[0] + lane), load<T>(from[1] + lane), load<T>(from[2] + lane)};
}
template <class T, std::size_t kCount>
SIMD_INLINE void store_vec3(const LaneVec3<T>& a, float (&to)[3][kCount], int lane) {
    store(a.x, to[0] + lane);
    store(a.y, to[1] + lane);
    store(a.z, to[2] + lane);
}

} // namespace scanout::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
