// Double-double numbers of the oracle's own: an unevaluated sum of two doubles, about 104 bits.
// Products are split by std::fma, not by the renderer's way. Dekker 1971; Shewchuk 1997.
#pragma once

#include <cmath>

namespace scanout::oracle {

struct Twofold {
    double high = 0, low = 0;

    Twofold() = default;
    Twofold(double x) : high(x) {} // a number is a number: implicit on purpose
    Twofold(double h, double l) : high(h + l), low(l - (high - h)) {}
    double nearest() const { return high + low; }
};

inline Twofold operator+(const Twofold& a, const Twofold& b) {
    const double sum = a.high + b.high, part = sum - a.high;
    const double rest = (a.high - (sum - part)) + (b.high - part);
    return {sum, rest + (a.low + b.low)};
}
inline Twofold operator-(const Twofold& a) {
    Twofold out;
    out.high = -a.high;
    out.low = -a.low;
    return out;
}
inline Twofold operator-(const Twofold& a, const Twofold& b) {
    return a + -b;
}
inline Twofold operator*(const Twofold& a, const Twofold& b) {
    const double product = a.high * b.high;
    const double rest = std::fma(a.high, b.high, -product);
    return {product, rest + (a.high * b.low + a.low * b.high)};
}
inline Twofold operator/(const Twofold& a, const Twofold& b) {
    const double first = a.high / b.high;
    const Twofold rest = a - b * Twofold(first);
    return {first, rest.nearest() / b.high};
}

} // namespace scanout::oracle
