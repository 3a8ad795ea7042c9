// Single precision transcendentals for the shading kernels, written over a lane type F: float here,
// a vector of floats in a SIMD kernel, which brings + - * / on F and overloads of the helpers in
// lane_helpers for itself. Each is a fixed sequence of float + - * and integer bit operations, with
// no table and no branch on data, so that all lane types give the same bits. No result is ever NaN.
//
// Measured against MPFR (tests/math/transcendental_f32_test.cpp): log2 1.5 ulp;
// exp2 1.2 ulp; pow(x, y) for x in [0, 1], y in [0, 10000]: absolute error 2^-23.4.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

namespace scanout {

// What F = float needs; F and its integers I have the same number of lanes.
inline namespace lane_helpers {
inline std::int32_t bits_of(float x) {
    return std::bit_cast<std::int32_t>(x);
}
inline float from_bits(std::int32_t bits) {
    return std::bit_cast<float>(bits);
}
inline float to_float(std::int32_t i) {
    return static_cast<float>(i);
}
inline std::int32_t add(std::int32_t a, std::int32_t b) { // wraps around, as lanes do
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}
inline std::int32_t subtract(std::int32_t a, std::int32_t b) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}
template <int kCount>
std::int32_t shift_left(std::int32_t i) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(i) << kCount);
}
template <int kCount>
std::int32_t shift_right(std::int32_t i) { // arithmetic
    return i >> kCount;
}
inline float select(bool mask, float yes, float no) {
    return mask ? yes : no;
}
} // namespace lane_helpers

// log2 x for normal x > 0; anything smaller, negative or NaN gives -infinity.
template <class F>
F log2_lanes(F x) {
    using I = decltype(bits_of(x));
    constexpr float kInf = std::numeric_limits<float>::infinity();
    // x = 2^k (1 + t), 1 + t in [sqrt(1/2), sqrt(2)): t is exact, and k = 0 near 1, where log2
    // vanishes
    const I k = shift_right<23>(subtract(bits_of(x), I(0x3f3504f3))); // bits of sqrt(1/2)
    const F t = from_bits(subtract(bits_of(x), shift_left<23>(k))) - F(1.0F);
    // log2(1 + t) = t + t Q(t); Q minimax for the relative error of the whole, 2^-26.5
    const F t2 = t * t;
    const F q01 = F(0x1.c551dap-2F) + F(-0x1.715470p-1F) * t;
    const F q23 = F(0x1.ec7042p-2F) + F(-0x1.715aa0p-2F) * t;
    const F q45 = F(0x1.27897cp-2F) + F(-0x1.eac554p-3F) * t;
    const F q67 = F(0x1.a1db56p-3F) + F(-0x1.861244p-3F) * t;
    const F q89 = F(0x1.829f80p-3F) + F(-0x1.d2f51cp-4F) * t;
    const F q = q01 + t2 * (q23 + t2 * (q45 + t2 * (q67 + t2 * q89)));
    const F y = to_float(k) + (t + t * q);
    return select(x >= F(std::numeric_limits<float>::min()), select(x < F(kInf), y, F(kInf)),
                  F(-kInf));
}

// 2^x; x below -126 or NaN gives 0, x of 128 and above infinity; exact for integers.
template <class F>
F exp2_lanes(F x) {
    using I = decltype(bits_of(x));
    // Adding 1.5 2^23 rounds to an integer and leaves it in the low bits.
    constexpr float kRounder = 12582912.0F;
    const F shifted = x + F(kRounder);
    const I k = subtract(bits_of(shifted), I(0x4b400000));
    const F f = x - (shifted - F(kRounder)); // exact, in [-1/2, 1/2]
    // 2^f = 1 + f P(f), minimax, relative error 2^-28
    const F p45 = F(0x1.5f0a66p-10F) + F(0x1.3f906cp-13F) * f;
    const F p23 = F(0x1.c6af78p-5F) + F(0x1.3b30b0p-7F) * f;
    const F p01 = F(0x1.62e430p-1F) + F(0x1.ebfbd8p-3F) * f;
    const F f2 = f * f;
    const F y = F(1.0F) + f * (p01 + f2 * (p23 + f2 * p45));
    // 2^128 is no float, its root is
    const I half = shift_right<1>(k);
    const F scale_1 = from_bits(shift_left<23>(add(half, I(127))));
    const F scale_2 = from_bits(shift_left<23>(add(subtract(k, half), I(127))));
    const F in_range =
        select(x < F(128.0F), y * scale_1 * scale_2, F(std::numeric_limits<float>::infinity()));
    return select(x >= F(-126.0F), in_range, F(0.0F));
}

// x^y for x in [0, infinity), y >= 0 finite; x below 2^-126 or NaN counts as 0. y == 0 gives 1.
template <class F>
F pow_lanes(F x, F y) {
    return select(y == F(0.0F), F(1.0F), exp2_lanes(y * log2_lanes(x)));
}

inline float log2_f32(float x) {
    return log2_lanes(x);
}
inline float exp2_f32(float x) {
    return exp2_lanes(x);
}
inline float pow_f32(float x, float y) {
    return pow_lanes(x, y);
}

} // namespace scanout
