// atan2 and acos: the angle of a vector in the first octant is atan(i/16) from a table plus the
// rest, whose tangent is (y - c x) / (x + c y), at most 1/32, so that a short series is enough.
#include "math/bits.h"
#include "math/double_double.h"
#include "math/transcendental.h"

namespace scanout {
namespace {

constexpr Dd kHalfPi = {0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54};
constexpr Dd kPi = {0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

// atan(i / 16) for i = 0 .. 16.
constexpr Dd kAtanTable[] = {
    {0.0, 0.0},
    {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60},
    {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
    {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58},
    {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
    {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57},
    {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
    {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56},
    {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
    {0x1.0657e94db30d0p-1, -0x1.d5b495f6349e6p-56},
    {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
    {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55},
    {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
    {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57},
    {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
    {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56},
    {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55},
};

// The angle of (x, y), 0 <= y <= x (up to rounding), 1/2 <= x < 2; relative error below 2^-63.
Dd octant_angle(Dd y, Dd x) {
    const double quotient = y.hi / x.hi;
    if (quotient < 0x1p-60) return {quotient};
    const int i = static_cast<int>(nearest_integer(quotient * 16.0));
    const Dd c = {i / 16.0};
    const Dd t = i == 0 ? y / x : (y - c * x) / (x + c * y);
    const double z = t.hi * t.hi;
    const double series =
        -1.0 / 3 + z * (1.0 / 5 + z * (-1.0 / 7 + z * (1.0 / 9 + z * (-1.0 / 11))));
    return kAtanTable[i] + quick_two_sum(t.hi, t.lo + t.hi * (z * series));
}

// The angle of (x, y) or, mirrored, of (-x, y), in [0, pi]; x, y >= 0, the greater in [1/2, 2).
double half_plane_angle(Dd y, Dd x, bool mirrored) {
    const Dd angle = y.hi <= x.hi ? octant_angle(y, x) : kHalfPi - octant_angle(x, y);
    return mirrored ? (kPi - angle).hi : angle.hi;
}

} // namespace

double atan2(double y, double x) {
    if (x != x || y != y) return kNaN;
    double width = magnitude(x);
    double height = magnitude(y);
    if (width == kInfinity || height == kInfinity) {
        width = width == kInfinity ? 1.0 : 0.0;
        height = height == kInfinity ? 1.0 : 0.0;
    }
    const bool mirrored = sign_bit(x);
    if (height == 0 && width == 0) return with_sign_of(mirrored ? kPi.hi : 0.0, y);
    // atan q = q to 2^-120; the quotient of the unscaled numbers is right down to subnormal
    // results.
    if (!mirrored && height < width * 0x1p-60) return with_sign_of(height / width, y);
    const int exponent = -decompose(width > height ? width : height).exponent;
    const Dd scaled_y = {scale(height, exponent)};
    const Dd scaled_x = {scale(width, exponent)};
    return with_sign_of(half_plane_angle(scaled_y, scaled_x, mirrored), y);
}

double acos(double x) {
    if (!(magnitude(x) <= 1.0)) return kNaN;
    const double width = magnitude(x);
    // sqrt((1 - x)(1 + x)) in double-double: one Newton step on the square root of the high part
    const Dd square = two_sum(1.0, -width) * two_sum(1.0, width);
    Dd height = {};
    if (square.hi > 0) {
        const double root = sqrt(square.hi);
        const Dd rest = square - two_product(root, root);
        height = quick_two_sum(root, rest.hi / (2.0 * root));
    }
    return half_plane_angle(height, Dd{width}, x < 0);
}

} // namespace scanout
