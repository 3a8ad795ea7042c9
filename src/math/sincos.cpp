// sin, cos and tan of radians and degrees: exact argument reduction to |r| <= pi/4 in double-double
// (Cody and Waite 1980, with three parts of pi/2), then Taylor series whose first correction is
// double-double.
#include "math/bits.h"
#include "math/double_double.h"
#include "math/transcendental.h"

#include <cstdint>

namespace scanout {
namespace {

constexpr double kTiny = 0x1p-27; // below it sin x = tan x = x to 0.1 ulp
constexpr double kRadiansLimit = 0x1p30;
constexpr Dd kRadiansPerDegree = {0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62};

// An angle as quadrant * (a quarter turn) + rest, |rest| <= pi/4 (1 + 2^-40) radians.
struct Reduced {
    int quadrant; // 0..3
    Dd rest;
};

// For |x| <= 2^30. The doubles of that range stay 2^-60 away from multiples of pi/2; the error here
// is below 2^-125.
Reduced reduce_radians(double x) {
    constexpr double kTwoByPi = 0x1.45f306dc9c883p-1;
    constexpr double kFirst = 0x1.921fb54442d18p+0; // pi/2 = first + second + third
    constexpr double kSecond = 0x1.1a62633145c07p-54;
    constexpr double kThird = -0x1.f1976b7ed8fbcp-110;
    const auto n = nearest_integer(x * kTwoByPi);
    if (n == 0) return {0, Dd{x}};
    const auto turns = static_cast<double>(n);
    const Dd first = two_product(turns, kFirst);
    const Dd second = two_product(turns, kSecond);
    const Dd a = two_sum(x - first.hi, -first.lo); // x - first.hi is exact (Sterbenz)
    const Dd b = two_sum(a.hi, -second.hi);
    const Dd rest = quick_two_sum(b.hi, ((b.lo + a.lo) - second.lo) - turns * kThird);
    return {static_cast<int>(n & 3), rest};
}

// |degrees| modulo 360 where every double is an integer: no rounding at any size.
double huge_modulo_360(double degrees) {
    const auto [mantissa, exponent] = decompose(degrees);
    auto rest = static_cast<std::uint64_t>(mantissa * 0x1p52) % 360;
    for (int i = 52; i < exponent; ++i)
        rest = rest * 2 % 360;
    return static_cast<double>(rest);
}

// For finite degrees >= 0: splits off the quadrant; the rest is exact and still in degrees.
struct ReducedDegrees {
    int quadrant;
    double rest;
};

ReducedDegrees reduce_degrees(double degrees) {
    if (degrees >= 0x1p53) degrees = huge_modulo_360(degrees);
    const auto n = nearest_integer(degrees / 90.0);
    return {static_cast<int>(n & 3), degrees - 90.0 * static_cast<double>(n)};
}

// sin r for |r| <= pi/4, relative error below 2^-59.
Dd sin_series(Dd r) {
    constexpr Dd kSixth = {0x1.5555555555555p-3, 0x1.5555555555555p-57};
    const Dd z = r * r;
    const double x = z.hi;
    const double tail =
        x * (1.0 / 120 + x * (-1.0 / 5040 +
                              x * (1.0 / 362880 + x * (-1.0 / 39916800 +
                                                       x * (1.0 / 6227020800 +
                                                            x * (-1.0 / 1307674368000 +
                                                                 x * (1.0 / 355687428096000)))))));
    return r - r * z * (kSixth - Dd{tail});
}

// cos r for |r| <= pi/4, relative error below 2^-58.
Dd cos_series(Dd r) {
    const Dd z = r * r;
    const double x = z.hi;
    const double tail =
        x * (1.0 / 24 +
             x * (-1.0 / 720 +
                  x * (1.0 / 40320 +
                       x * (-1.0 / 3628800 +
                            x * (1.0 / 479001600 +
                                 x * (-1.0 / 87178291200 + x * (1.0 / 20922789888000 -
                                                                x * (1.0 / 6402373705728000))))))));
    return Dd{1.0} - z * (Dd{0.5} - Dd{tail});
}

// Quadrants shifted by one turn a sine into a cosine.
Dd sin_of(int quadrant, Dd rest) {
    const Dd value = (quadrant & 1) != 0 ? cos_series(rest) : sin_series(rest);
    return (quadrant & 2) != 0 ? -value : value;
}

bool beyond(double x) {
    return !(magnitude(x) <= kRadiansLimit);
} // NaN as well

} // namespace

double sin(double radians) {
    if (beyond(radians)) return kNaN;
    if (magnitude(radians) < kTiny) return radians;
    const auto [quadrant, rest] = reduce_radians(radians);
    return sin_of(quadrant, rest).hi;
}

double cos(double radians) {
    if (beyond(radians)) return kNaN;
    const auto [quadrant, rest] = reduce_radians(radians);
    return sin_of(quadrant + 1, rest).hi;
}

double tan(double radians) {
    if (beyond(radians)) return kNaN;
    if (magnitude(radians) < kTiny) return radians;
    const auto [quadrant, rest] = reduce_radians(radians);
    return (sin_of(quadrant, rest) / sin_of(quadrant + 1, rest)).hi;
}

double sin_degrees(double degrees) {
    if (!(magnitude(degrees) < kInfinity)) return kNaN;
    if (magnitude(degrees) < kTiny) return radians(degrees);
    const auto [quadrant, rest] = reduce_degrees(magnitude(degrees));
    const double value = sin_of(quadrant, Dd{rest} * kRadiansPerDegree).hi;
    if (value == 0) return with_sign_of(0.0, degrees);
    return degrees < 0 ? -value : value;
}

double cos_degrees(double degrees) {
    if (!(magnitude(degrees) < kInfinity)) return kNaN;
    const auto [quadrant, rest] = reduce_degrees(magnitude(degrees));
    return sin_of(quadrant + 1, Dd{rest} * kRadiansPerDegree).hi + 0.0; // + 0.0: never -0
}

} // namespace scanout
