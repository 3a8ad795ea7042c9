// Single precision transcendentals in lanes, for the shading kernels. Each is a fixed sequence of
// float + - * and integer bit operations, with no table and no branch on data, so that all targets
// give the same bits. No result is ever NaN. They stand beside the lanes, where kernels find them.
//
// Measured against MPFR (tests/math/lanes_test.cpp): log2 1.5 ulp; exp2 1.2 ulp; pow(x, y) for x in
// [0, 1], y in [0, 10000]: absolute error 2^-23.4; atan2 3 ulp.
#if defined(SCANOUT_MATH_TRANSCENDENTAL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_MATH_TRANSCENDENTAL_INL_H
#undef SCANOUT_MATH_TRANSCENDENTAL_INL_H
#else
#define SCANOUT_MATH_TRANSCENDENTAL_INL_H
#endif

#include <limits>

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scanout::simd::HWY_NAMESPACE {

inline constexpr float kMinNormal = std::numeric_limits<float>::min();

// log2 x for normal x > 0; of others some number.
template <class D>
SIMD_INLINE Float<D> log2_of_normal(Float<D> x) {
    using F = Float<D>;
    using I = Int<D>;
    // x = 2^k (1 + t), 1 + t in [sqrt(1/2), sqrt(2)): t is exact, and k = 0 near 1, where log2
    // vanishes
    const I k = shift_right<23>(bits_of(x) - I(0x3f3504f3)); // bits of sqrt(1/2)
    const F t = from_bits(bits_of(x) - shift_left<23>(k)) - F(1.0F);
    // log2(1 + t) = t + t Q(t); Q minimax for the relative error of the whole, 2^-26.5
    const F t2 = t * t;
    const F q01 = F(0x1.c551dap-2F) + F(-0x1.715470p-1F) * t;
    const F q23 = F(0x1.ec7042p-2F) + F(-0x1.715aa0p-2F) * t;
    const F q45 = F(0x1.27897cp-2F) + F(-0x1.eac554p-3F) * t;
    const F q67 = F(0x1.a1db56p-3F) + F(-0x1.861244p-3F) * t;
    const F q89 = F(0x1.829f80p-3F) + F(-0x1.d2f51cp-4F) * t;
    const F q = q01 + t2 * (q23 + t2 * (q45 + t2 * (q67 + t2 * q89)));
    return to_f32(k) + (t + t * q);
}

// log2 x for x that is at most 1; anything below 2^-126, or NaN, gives -infinity.
template <class D>
SIMD_INLINE Float<D> log2_of_share(Float<D> x) {
    using F = Float<D>;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    return select(x >= F(kMinNormal), log2_of_normal(x), F(-kInfinity));
}

// The same for any x.
template <class D>
SIMD_INLINE Float<D> log2(Float<D> x) {
    const Float<D> infinity = std::numeric_limits<float>::infinity();
    return select(x == infinity, infinity, log2_of_share(x));
}

// 2^x for x in [-126, 128); of others some number.
template <class D>
SIMD_INLINE Float<D> normal_exp2(Float<D> x) {
    using F = Float<D>;
    // Adding 1.5 2^23 rounds to an integer and leaves it in the low bits.
    constexpr float kRounder = 12582912.0F;
    const F shifted = x + F(kRounder);
    const F f = x - (shifted - F(kRounder)); // exact, in [-1/2, 1/2]
    // 2^f = 1 + f P(f), minimax, relative error 2^-28
    const F p45 = F(0x1.5f0a66p-10F) + F(0x1.3f906cp-13F) * f;
    const F p23 = F(0x1.c6af78p-5F) + F(0x1.3b30b0p-7F) * f;
    const F p01 = F(0x1.62e430p-1F) + F(0x1.ebfbd8p-3F) * f;
    const F f2 = f * f;
    const F y = F(1.0F) + f * (p01 + f2 * (p23 + f2 * p45));
    // Times 2^k: the integer is added to the exponent, all other bits of `shifted` are shifted out.
    // The product is a normal float: at the ends, k = -126 has f >= 0, and k = 128 has f < 0.
    return from_bits(bits_of(y) + shift_left<23>(bits_of(shifted)));
}

// 2^x for x that is at most 0; below -126, or NaN, gives 0.
template <class D>
SIMD_INLINE Float<D> exp2_to_share(Float<D> x) {
    using F = Float<D>;
    return select(x >= F(-126.0F), normal_exp2(x), F(0.0F));
}

// The same for any x; of 128 and above infinity; exact for integers.
template <class D>
SIMD_INLINE Float<D> exp2(Float<D> x) {
    const Float<D> infinity = std::numeric_limits<float>::infinity();
    return select(x >= Float<D>(128.0F), infinity, exp2_to_share(x));
}

// x^y for x in [0, infinity), y >= 0 finite; x below 2^-126 or NaN counts as 0. y == 0 gives 1.
template <class D>
SIMD_INLINE Float<D> pow(Float<D> x, Float<D> y) {
    return select(y == Float<D>(0.0F), Float<D>(1.0F), exp2(y * log2(x)));
}

// pow, the same bits, for x that is at most 1 or NaN.
template <class D>
SIMD_INLINE Float<D> pow_of_share(Float<D> x, Float<D> y) {
    using F = Float<D>;
    return select(y == F(0.0F), F(1.0F), exp2_to_share(y * log2_of_share(x)));
}

// The angle of (x, y) in radians, -pi to pi, for finite x and y; atan2(0, 0) is 0.
template <class D>
SIMD_INLINE Float<D> atan2(Float<D> y, Float<D> x) {
    using F = Float<D>;
    constexpr float kPi = 0x1.921fb6p+1F;
    const F width = abs(x), height = abs(y);
    const auto steep = height > width;
    const F longer = select(steep, height, width), shorter = select(steep, width, height);
    const auto some = longer > F(0.0F);
    const F t = select(some, shorter / select(some, longer, F(1.0F)), F(0.0F));
    // atan(t) = t P(t^2) on [0, 1]; P minimax for the relative error, 2^-25.9
    const F s = t * t;
    const F p01 = F(0x1.000000p+0F) + F(-0x1.5554a6p-2F) * s;
    const F p23 = F(0x1.9972e8p-3F) + F(-0x1.22e404p-3F) * s;
    const F p45 = F(0x1.b3da58p-4F) + F(-0x1.336056p-4F) * s;
    const F p67 = F(0x1.5dbaccp-5F) + F(-0x1.0744e8p-6F) * s;
    const F s2 = s * s;
    const F p = p01 + s2 * (p23 + s2 * (p45 + s2 * (p67 + s2 * F(0x1.758abep-9F))));
    const F low = t * p; // 0 to pi / 4
    const F right = select(steep, F(kPi / 2) - low, low);
    const F upper = select(x < F(0.0F), F(kPi) - right, right);
    return select(y < F(0.0F), -upper, upper);
}

} // namespace scanout::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
