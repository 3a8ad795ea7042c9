#include "math/exp_log.h"

#include "math/transcendental.h"

namespace scanout {

double exp2(double x) {
    if (x != x) return kNaN;
    return detail::exp2_dd(Dd{x});
}

double log2(double x) {
    if (x != x || x < 0) return kNaN;
    if (x == 0) return -kInfinity;
    if (x == kInfinity) return kInfinity;
    return detail::log2_dd(x).hi;
}

double pow(double base, double exponent) {
    if (exponent == 0 || base == 1) return 1.0;
    if (base != base || exponent != exponent || base < 0) return kNaN;
    if (base == 0) return exponent > 0 ? 0.0 : kInfinity;
    if (base == kInfinity) return exponent > 0 ? kInfinity : 0.0;
    if (magnitude(exponent) == kInfinity) return (base > 1) == (exponent > 0) ? kInfinity : 0.0;
    return detail::pow_positive(base, exponent);
}

} // namespace scanout
