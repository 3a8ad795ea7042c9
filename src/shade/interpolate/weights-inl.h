// The weights of a triangle's vertices at its lanes, and attributes mixed by them.
#if defined(SCANOUT_SHADE_WEIGHTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_WEIGHTS_INL_H
#undef SCANOUT_SHADE_WEIGHTS_INL_H
#else
#define SCANOUT_SHADE_WEIGHTS_INL_H
#endif

#include "shade/check_lanes.h"
#include "shade/stage.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade::interpolate)

// Lanes of a block from `first` on, of which `count` are of the run.
struct Live {
    int first, count;
};

// Checks before a clamp, which turns NaN into a number and so would hide it.
SIMD_INLINE void check_clamped([[maybe_unused]] F32 f, [[maybe_unused]] const Live& live) {
    if constexpr (kCheckLanes) {
        float lanes[kLanes];
        store(f, lanes);
        check_before_clamp(lanes, live.count < kLanes ? live.count : kLanes, live.first);
    }
}

// The weights of vertices 1 and 2; vertex 0 has the rest to 1.
struct Weights {
    F32 one, two;
    Live live;
};

SIMD_INLINE F64 area_at(const Primitive& t, int k, F64 x, F64 y) {
    return (F64(t.a[k]) * x + F64(t.b[k]) * y) + F64(t.c[k]);
}

// Weights from areas times 1/w.
SIMD_INLINE Weights weights_of(F32 p0, F32 p1, F32 p2, const Live& live) {
    const F32 sum = (p0 + p1) + p2;
    return {p1 / sum, p2 / sum, live};
}
// Weights from the vertices' areas, rounded to float once.
SIMD_INLINE Weights weights_of(const Primitive& t, F32 b0, F32 b1, F32 b2, const Live& live) {
    return weights_of(b0 * F32(t.inverse_w[0]), b1 * F32(t.inverse_w[1]), b2 * F32(t.inverse_w[2]),
                      live);
}

SIMD_INLINE Weights weights(const Primitive& t, F64 x, F64 y, const Live& live) {
    F64 b0 = area_at(t, 0, x, y), b1 = area_at(t, 1, x, y), b2 = area_at(t, 2, x, y);
    if (t.clipped) {
        // The snapped edge may lie slightly outside of the exact one, where areas are negative. A
        // common divisor brings the areas into the range of a float.
        check_clamped(to_f32(((b0 - b0) + (b1 - b1)) + (b2 - b2)), live); // 0 where finite
        const F64 zero = 0.0;
        b0 = maximum(b0, zero);
        b1 = maximum(b1, zero);
        b2 = maximum(b2, zero);
        const F64 largest = maximum(maximum(b0, b1), b2);
        const auto some = largest > zero;
        const F64 divisor = select(some, largest, F64(1.0));
        b0 = select(some, b0 / divisor, F64(1.0));
        b1 = select(some, b1 / divisor, F64(1.0));
        b2 = select(some, b2 / divisor, F64(1.0));
    }
    return weights_of(t, to_f32(b0), to_f32(b1), to_f32(b2), live);
}

// At samples on the grid of 1/256 pixel, within a pixel of the triangle. Gives the same bits from
// half as many registers: integers or doubles, the same whole numbers are rounded to floats.
SIMD_INLINE Weights weights(const Primitive& t, I32 x, I32 y, const Live& live) {
    if (!t.fits_int32) return weights(t, to_f64(x), to_f64(y), live);
    const auto area = [&](int k) SIMD_LAMBDA {
        return to_f32((I32(t.a_int32[k]) * x + I32(t.b_int32[k]) * y) + I32(t.c_int32[k]));
    };
    return weights_of(t, area(0), area(1), area(2), live);
}

// A vertex attribute, ready to be mixed: its value at vertex 0, the differences to the other
// vertices, and its range.
struct Spread {
    F32 base, one, two, low, high;
};
SIMD_INLINE Spread spread_of(F32 f0, F32 f1, F32 f2) {
    return {f0, f1 - f0, f2 - f0, minimum(minimum(f0, f1), f2), maximum(maximum(f0, f1), f2)};
}
SIMD_INLINE Spread spread_of(const float (&vertex)[3]) {
    return spread_of(vertex[0], vertex[1], vertex[2]);
}

SIMD_INLINE F32 mix(const Weights& w, const Spread& of) {
    const F32 f = of.base + (w.one * of.one + w.two * of.two);
    if constexpr (kCheckLanes) { // the clamp may also correct infinite differences
        const F32 zero = 0.0F;
        check_clamped(select((of.one - of.one == zero) & (of.two - of.two == zero), f, zero),
                      w.live);
    }
    return minimum(maximum(f, of.low), of.high);
}
SIMD_INLINE F32 mix(const Weights& w, F32 f0, F32 f1, F32 f2) {
    return mix(w, spread_of(f0, f1, f2));
}
SIMD_INLINE F32 mix(const Weights& w, const float (&vertex)[3]) {
    return mix(w, vertex[0], vertex[1], vertex[2]);
}

SIMD_END

#endif
