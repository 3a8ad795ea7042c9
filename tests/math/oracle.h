// The oracle: MPFR with 200 bits, an implementation that shares
// nothing with ours. Errors are in ulps of the exact result, as a double or a float would round it.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <mpfr.h>

namespace scanout::test {

class Real {
public:
    explicit Real(double x = 0) {
        mpfr_init2(value_, 200);
        mpfr_set_d(value_, x, MPFR_RNDN);
    }
    Real(const Real&) = delete;
    Real& operator=(const Real&) = delete;
    ~Real() { mpfr_clear(value_); }
    mpfr_ptr get() { return value_; }
    double nearest() const { return mpfr_get_d(value_, MPFR_RNDN); }

private:
    mpfr_t value_;
};

// |got - exact| in units of 2^(exponent of exact - digits + 1), subnormal numbers as they are
// spaced. Infinite and NaN results must agree exactly: 0 if they do, infinity if not.
inline double ulps(double got, Real& exact, int digits = 53, int least_exponent = -1022) {
    const double nearest = exact.nearest();
    if (!std::isfinite(got) || !mpfr_number_p(exact.get())) {
        if (std::isnan(got) && std::isnan(nearest)) return 0;
        // Rounded beyond the largest number counts as infinite.
        return got == nearest ? 0 : std::numeric_limits<double>::infinity();
    }
    long exponent = mpfr_zero_p(exact.get()) ? least_exponent : mpfr_get_exp(exact.get()) - 1;
    if (exponent < least_exponent) exponent = least_exponent;
    Real difference(got);
    mpfr_sub(difference.get(), difference.get(), exact.get(), MPFR_RNDN);
    mpfr_mul_2si(difference.get(), difference.get(), digits - 1 - exponent, MPFR_RNDN);
    return std::fabs(difference.nearest());
}

// splitmix64 (Steele, Lea and Flood 2014): the same points on every machine, as std's distributions
// are not.
class Points {
public:
    explicit Points(std::uint64_t seed) : state_(seed) {}
    std::uint64_t bits() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    double uniform(double low, double high) { return low + (high - low) * unit(); }
    // Either sign, 2^low .. 2^high, every binade alike.
    double any_size(int low, int high) {
        const int exponent =
            low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low));
        const double size = std::ldexp(1.0 + unit(), exponent);
        return (bits() & 1) != 0 ? size : -size;
    }

private:
    std::uint64_t state_;
};

} // namespace scanout::test
