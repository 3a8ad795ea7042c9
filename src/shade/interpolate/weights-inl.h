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

// A clamp makes a number of NaN, so that nothing would be seen after it.
HWY_INLINE void check_clamped([[maybe_unused]] F32x8 f, [[maybe_unused]] const Live& live) {
    if constexpr (kCheckLanes) {
        float lanes[kLanesX8];
        store(f, lanes);
        check_before_clamp(lanes, live.count < kLanesX8 ? live.count : kLanesX8, live.first);
    }
}

// Of vertices 1 and 2; vertex 0 has the rest.
struct Weights {
    F32x8 one, two;
    Live live;
};

HWY_INLINE F64x8 area_at(const Primitive& t, int k, F64x8 x, F64x8 y) {
    return (F64x8(t.a[k]) * x + F64x8(t.b[k]) * y) + F64x8(t.c[k]);
}

// Of areas times 1/w.
HWY_INLINE Weights weights_of(F32x8 p0, F32x8 p1, F32x8 p2, const Live& live) {
    const F32x8 sum = (p0 + p1) + p2;
    return {p1 / sum, p2 / sum, live};
}
// Of vertices' areas that are rounded once.
HWY_INLINE Weights weights_of(const Primitive& t, F32x8 b0, F32x8 b1, F32x8 b2, const Live& live) {
    return weights_of(b0 * F32x8(t.inverse_w[0]), b1 * F32x8(t.inverse_w[1]),
                      b2 * F32x8(t.inverse_w[2]), live);
}

HWY_INLINE Weights weights(const Primitive& t, F64x8 x, F64x8 y, const Live& live) {
    F64x8 b0 = area_at(t, 0, x, y), b1 = area_at(t, 1, x, y), b2 = area_at(t, 2, x, y);
    if (t.clipped) {
        // The snapped edge may lie a little further out than the exact one. A common factor brings
        // the weights into the range of a float.
        check_clamped(to_f32(((b0 - b0) + (b1 - b1)) + (b2 - b2)), live); // 0 of what is finite
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
    return weights_of(t, to_f32(b0), to_f32(b1), to_f32(b2), live);
}

// At samples on the grid of 1/256 pixel, within a pixel of the triangle. The same bits from half as
// many registers: both ways round the same whole numbers to floats.
HWY_INLINE Weights weights(const Primitive& t, I32x8 x, I32x8 y, const Live& live) {
    if (!t.whole) return weights(t, to_f64(x), to_f64(y), live);
    const auto area = [&](int k) {
        return to_f32((I32x8(t.whole_a[k]) * x + I32x8(t.whole_b[k]) * y) + I32x8(t.whole_c[k]));
    };
    return weights_of(t, area(0), area(1), area(2), live);
}

HWY_INLINE F32x8 mix(const Weights& w, F32x8 f0, F32x8 f1, F32x8 f2) {
    const F32x8 d1 = f1 - f0, d2 = f2 - f0;
    const F32x8 f = f0 + (w.one * d1 + w.two * d2);
    if constexpr (kCheckLanes) { // differences beyond all floats are what the clamp is for, too
        const F32x8 zero = 0.0F;
        check_clamped(select((d1 - d1 == zero) & (d2 - d2 == zero), f, zero), w.live);
    }
    const F32x8 low = minimum(minimum(f0, f1), f2), high = maximum(maximum(f0, f1), f2);
    return minimum(maximum(f, low), high);
}
HWY_INLINE F32x8 mix(const Weights& w, const float (&vertex)[3]) {
    return mix(w, vertex[0], vertex[1], vertex[2]);
}

SIMD_END

#endif
