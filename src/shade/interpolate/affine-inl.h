// Interpolation that divides seldom: exact at some places of a triangle's row, straight between
// them. The places are the multiples of `step` pixels on the screen's x axis, and the ends of the
// row inside the triangle, so that nothing depends on tiles or runs and no weight is ever negative.
// Half-way it was the trick of 1990s' renderers (Hecker 1995; HARD-CASES 33).
//
// Where distances along a step have the ratio r, the error is (sqrt(r) - 1) / (sqrt(r) + 1) of what
// the attribute changes along it.
#if defined(SCANOUT_SHADE_AFFINE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_AFFINE_INL_H
#undef SCANOUT_SHADE_AFFINE_INL_H
#else
#define SCANOUT_SHADE_AFFINE_INL_H
#endif

#include "shade/interpolate/interpolate-inl.h"

SIMD_BEGIN(scanout::shade::interpolate)

// Screen areas alone: no division at all but by the whole area. Where a triangle was cut by the
// near plane it has no areas on the screen, and is interpolated exactly.
SIMD_INLINE void affine_lanes(ShadingBlock& b, const Wanted& want, const Run& run) {
    const Primitive& t = *run.primitive;
    if (t.clipped) return perspective_lanes(b, want, run);
    const double whole = (t.c[0] + t.c[1]) + t.c[2]; // the linear parts cancel
    const F64 inverse = 1.0 / whole;
    const OfRun of(t);
    for (int i = run.first; i < run.first + run.count; i += kLanes) {
        const F64 x = to_f64(load<I32>(b.x + i)), y = to_f64(load<I32>(b.y + i));
        store_attributes(b, want, of,
                         {to_f32(area_at(t, 1, x, y) * inverse),
                          to_f32(area_at(t, 2, x, y) * inverse),
                          {i, run.first + run.count - i}},
                         i);
    }
}

// A place in a row, and the exact weights there.
struct Anchor {
    double x; // 1/256 pixel
    float one, two;
};

// In the order of operations of weights(), one place at a time.
SIMD_INLINE Anchor anchor_at(const Primitive& t, double x, double y) {
    const auto area = [&](int k) SIMD_LAMBDA {
        const double b = (t.a[k] * x + t.b[k] * y) + t.c[k];
        return b > 0 ? b : 0.0; // an end of the row may round to just outside
    };
    const double p0 = area(0) * double{t.inverse_w[0]}, p1 = area(1) * double{t.inverse_w[1]},
                 p2 = area(2) * double{t.inverse_w[2]};
    const double sum = (p0 + p1) + p2;
    if (!(sum > 0)) return {x, 0.0F, 0.0F}; // a corner that is no wider than rounding
    return {x, static_cast<float>(p1 / sum), static_cast<float>(p2 / sum)};
}

// Where the row y enters and leaves the triangle, 1/256 pixel; within +-2^24.
struct Span {
    double from, to;
};
SIMD_INLINE Span span_of(const Primitive& t, double y) {
    Span span{-0x1p24, 0x1p24};
    for (int k = 0; k < 3; ++k) {
        if (t.a[k] == 0) continue;
        const double x = -(t.b[k] * y + t.c[k]) / t.a[k];
        if (t.a[k] > 0)
            span.from = x > span.from ? x : span.from;
        else
            span.to = x < span.to ? x : span.to;
    }
    return span;
}

// Lanes of pixels side by side.
struct Row {
    const Primitive* primitive;
    int first, count;
    std::int32_t x, y; // the first pixel's centre, 1/256 pixel
};

template <int kStep>
SIMD_INLINE void stepped_row(ShadingBlock& b, const Wanted& want, const Row& row) {
    constexpr std::int32_t kUnits = kStep * 256;
    const Primitive& t = *row.primitive;
    const double y = row.y;
    const OfRun of(t);
    const Span span = span_of(t, y);
    const auto place = [&](std::int32_t x) SIMD_LAMBDA {
        const double at = x;
        return anchor_at(t, at < span.from ? span.from : at > span.to ? span.to : at, y);
    };
    std::int32_t left = (row.x >= 0 ? row.x / kUnits : -((kUnits - 1 - row.x) / kUnits)) * kUnits;
    Anchor from = place(left);
    for (int item = 0; item < row.count;) {
        const Anchor to = place(left + kUnits);
        // The pixels whose centres lie before the next place.
        const int end = (left + kUnits - 1 - row.x) / 256 + 1;
        const int last = end < row.count ? end : row.count;
        const double length = to.x - from.x;
        const double inverse = length > 0 ? 1.0 / length : 0.0;
        for (int i = item; i < last; i += kLanes) {
            const int at = row.first + i;
            const Live live{at, row.count - i};
            const I32 place_x = load<I32>(b.x + at), place_y = load<I32>(b.y + at);
            const F64 x = to_f64(place_x);
            const F32 fraction = to_f32((x - F64(from.x)) * F64(inverse));
            Weights w{F32(from.one) + fraction * F32(to.one - from.one),
                      F32(from.two) + fraction * F32(to.two - from.two), live};
            // A sample beside the centre, as edge pixels have, lies in a row of its own.
            const auto centre =
                place_x == I32(row.x) + shift_left<8>(iota<I32>(i)) & place_y == I32(row.y);
            if (!all(centre)) {
                const Weights exact = weights(t, x, to_f64(place_y), live);
                w = {select(centre, w.one, exact.one), select(centre, w.two, exact.two), live};
            }
            store_attributes(b, want, of, w, at);
        }
        item = last;
        left += kUnits;
        from = to;
    }
}

template <int kStep>
SIMD_INLINE void stepped_lanes(ShadingBlock& b, const Wanted& want, const Run& run) {
    const int end = run.first + run.count;
    for (int first = run.first; first < end;) {
        const std::int32_t x = b.x[first] >> 8, y = b.y[first] >> 8;
        int next = first + 1;
        while (next < end && b.y[next] >> 8 == y && b.x[next] >> 8 == x + (next - first))
            ++next;
        stepped_row<kStep>(b, want,
                           {run.primitive, first, next - first, x * 256 + 128, y * 256 + 128});
        first = next;
    }
}

SIMD_END

#endif
