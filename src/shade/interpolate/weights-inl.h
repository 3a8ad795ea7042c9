// The weights of a triangle's vertices at its lanes, and attributes mixed by them.
#if defined(SCANOUT_SHADE_WEIGHTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_WEIGHTS_INL_H
#undef SCANOUT_SHADE_WEIGHTS_INL_H
#else
#define SCANOUT_SHADE_WEIGHTS_INL_H
#endif

#include "shade/stage.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade::interpolate)

// Of vertices 1 and 2; vertex 0 has the rest.
struct Weights {
    F32x8 one, two;
};

HWY_INLINE F64x8 area_at(const Primitive& t, int k, F64x8 x, F64x8 y) {
    return (F64x8(t.a[k]) * x + F64x8(t.b[k]) * y) + F64x8(t.c[k]);
}

HWY_INLINE Weights weights(const Primitive& t, F64x8 x, F64x8 y) {
    F64x8 b0 = area_at(t, 0, x, y), b1 = area_at(t, 1, x, y), b2 = area_at(t, 2, x, y);
    if (t.clipped) {
        // The snapped edge may lie a little further out than the exact one. A common factor brings
        // the weights into the range of a float.
        const F64x8 zero = 0.0;
        b0 = maximum(b0, zero);
        b1 = maximum(b1, zero);
        b2 = maximum(b2, zero);
        const F64x8 largest = maximum(maximum(b0, b1), b2);
        const auto some = largest > zero;
        const F64x8 divisor = select(some, largest, F64x8(1.0));
        b0 = select(some, b0 / divisor, F64x8(1.0));
        b1 = select(some, b1 / divisor, F64x8(1.0));
        b2 = select(some, b2 / divisor, F64x8(1.0));
    }
    const F32x8 p0 = to_f32(b0) * F32x8(t.inverse_w[0]);
    const F32x8 p1 = to_f32(b1) * F32x8(t.inverse_w[1]);
    const F32x8 p2 = to_f32(b2) * F32x8(t.inverse_w[2]);
    const F32x8 sum = (p0 + p1) + p2;
    return {p1 / sum, p2 / sum};
}

HWY_INLINE F32x8 mix(const Weights& w, const float (&vertex)[3]) {
    const F32x8 f0 = vertex[0], f1 = vertex[1], f2 = vertex[2];
    const F32x8 f = f0 + (w.one * (f1 - f0) + w.two * (f2 - f0));
    const F32x8 low = minimum(minimum(f0, f1), f2), high = maximum(maximum(f0, f1), f2);
    return minimum(maximum(f, low), high);
}

SIMD_END

#endif
