// Doubles taken apart and put together by integer operations: exponent, power of two, sign.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

namespace scanout {

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
// The one NaN that src/math makes: the NaN of 0/0 has another sign on x86 than on Arm.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

constexpr double magnitude(double x) {
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & ~(std::uint64_t{1} << 63));
}

constexpr bool sign_bit(double x) {
    return (std::bit_cast<std::uint64_t>(x) >> 63) != 0;
}

constexpr double with_sign_of(double size, double sign) {
    return sign_bit(sign) ? -magnitude(size) : magnitude(size);
}

// An integer nearest to x (a tie's neighbour may round either way), |x| < 2^52; lround is libm's.
constexpr std::int64_t nearest_integer(double x) {
    return static_cast<std::int64_t>(x + (x < 0 ? -0.5 : 0.5));
}

// 2^exponent, exponent in [-1022, 1023].
constexpr double power_of_two(int exponent) {
    return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52);
}

// x 2^exponent, exponent in [-2044, 2046]; rounds at most once when 1/2 <= |x| < 2.
constexpr double scale(double x, int exponent) {
    const int half = exponent / 2;
    return x * power_of_two(half) * power_of_two(exponent - half);
}

struct Decomposed {
    double mantissa; // in [1, 2)
    int exponent;
};

// x = mantissa 2^exponent, for finite x > 0, subnormal numbers included.
constexpr Decomposed decompose(double x) {
    int exponent = 0;
    if (x < power_of_two(-1022)) {
        x *= power_of_two(54);
        exponent = -54;
    }
    const auto bits = std::bit_cast<std::uint64_t>(x);
    constexpr std::uint64_t kFraction = (std::uint64_t{1} << 52) - 1;
    exponent += static_cast<int>(bits >> 52) - 1023;
    return {std::bit_cast<double>((bits & kFraction) | std::bit_cast<std::uint64_t>(1.0)),
            exponent};
}

} // namespace scanout
