#include "math/transcendental.h"

#include "math/bits.h"
#include "math/double_double.h"

#include <cmath>

namespace scanout {

double sqrt(double x) {
    if (x < 0 || x != x) return kNaN;
    return std::sqrt(x); // one instruction, correctly rounded by IEEE 754
}

double cbrt(double x) {
    if (x == 0 || !(magnitude(x) < kInfinity)) return x == x ? x : kNaN;
    auto [m, exponent] = decompose(magnitude(x));
    const int third = (exponent + 1074) / 3 - 358; // floor(exponent / 3)
    m *= power_of_two(exponent - 3 * third);       // in [1, 8)
    // Halley's method: an error of 9 % becomes 5e-4, 8e-11 and rounding noise.
    double r = 0.9 + 0.14 * m;
    for (int i = 0; i < 3; ++i) {
        const double cube = r * r * r;
        r *= (cube + 2.0 * m) / (2.0 * cube + m);
    }
    const Dd cube = two_product(r, r) * Dd{r};
    r += ((m - cube.hi) - cube.lo) / (3.0 * r * r);
    return with_sign_of(r * power_of_two(third), x);
}

// x times a constant that is known to 106 bits; scaled where the exact product would lose bits.
static double times(double x, Dd constant) {
    if (!(magnitude(x) < kInfinity)) return x == x ? x : kNaN;
    if (magnitude(x) > 0x1p500) return (Dd{x * 0x1p-500} * constant).hi * 0x1p500;
    if (magnitude(x) < 0x1p-500) return x == 0 ? x : (Dd{x * 0x1p500} * constant).hi * 0x1p-500;
    return (Dd{x} * constant).hi;
}

double radians(double degrees) {
    return times(degrees, {0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62});
}

double degrees(double radians) {
    return times(radians, {0x1.ca5dc1a63c1f8p+5, -0x1.1e7ab456405f9p-49});
}

} // namespace scanout
