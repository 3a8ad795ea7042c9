#include "simd/vec3_operations.h"

#define SIMD_FILE "simd/vec3_operations.cpp"
#include "simd/for_each_target.h"

#include "simd/vec3-inl.h"

SIMD_BEGIN(scanout::test)

template <class T, class Number>
SIMD_INLINE LaneVec3<T> read(const Vectors<Number>& from) {
    return {load<T>(from.x), load<T>(from.y), load<T>(from.z)};
}
template <class T, class Number>
SIMD_INLINE void write(const LaneVec3<T>& v, Vectors<Number>& to) {
    store(v.x, to.x);
    store(v.y, to.y);
    store(v.z, to.z);
}

template <class T, class Number>
SIMD_INLINE void operations(const Vec3Operands<Number>& in, Vec3Results<Number>& out) {
    using V = LaneVec3<T>;
    const V a = read<T>(in.a), b = read<T>(in.b);
    const T s = load<T>(in.s);
    out.lanes = static_cast<int>(T::kLanes);
    write(a + b, out.sum);
    write(a - b, out.difference);
    write(a * b, out.product);
    write(a * s, out.scaled);
    write(abs(a), out.sizes);
    write(cross(a, b), out.crossed);
    write(select(a.x < b.x, a, b), out.selected);
    write(normalised(a, s, s > T(Number{0}), b), out.normalised);
    write(transformed(in.matrix, a), out.turned);
    write(everywhere<V>(in.row), out.of_row);
    write(everywhere<V>(in.plain), out.of_plain);
    write(splat(s), out.splat);
    store(dot(a, b), out.dot);
    store(length_squared(a), out.squared);
    store(length(a), out.length);
    store(greatest(a), out.greatest);
}

void vec3_wide(const Vec3Operands<float>& in, Vec3Results<float>& out) {
    operations<F32>(in, out);
}
void vec3_narrow(const Vec3Operands<float>& in, Vec3Results<float>& out) {
    operations<F32x8>(in, out);
}
void vec3_double(const Vec3Operands<double>& in, Vec3Results<double>& out) {
    operations<F64>(in, out);
}

int vec3_copy(const float (&from)[3][kCopied], int first, float (&to)[3][kCopied]) {
    store_vec3(load_vec3<Vec3F32>(from, first), to, first);
    return kLanes;
}

SIMD_END

#if SIMD_ONCE
namespace scanout::test {

SIMD_REGISTER(vec3_wide);
SIMD_REGISTER(vec3_narrow);
SIMD_REGISTER(vec3_double);
SIMD_REGISTER(vec3_copy);

void run_vec3(bool narrow, const Vec3Operands<float>& in, Vec3Results<float>& out) {
    if (narrow)
        SIMD_CALL(vec3_narrow, in, out);
    else
        SIMD_CALL(vec3_wide, in, out);
}
void run_vec3(const Vec3Operands<double>& in, Vec3Results<double>& out) {
    SIMD_CALL(vec3_double, in, out);
}
int copy_vec3(const float (&from)[3][kCopied], int first, float (&to)[3][kCopied]) {
    return SIMD_CALL(vec3_copy, from, first, to);
}

} // namespace scanout::test
#endif
