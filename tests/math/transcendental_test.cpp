// Every double function against MPFR: 10^5 points a range, the greatest error bounded by what
// math/transcendental.h states.
#include "math/transcendental.h"
#include "oracle.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

using Pair = std::pair<double, double>;
constexpr int kArguments = 100000;

// The greatest error of f over the points, in ulps; exact(result, a, b) is the oracle.
template <class Function, class Exact, class Make>
void expect_error_below(double bound, Function f, Exact exact, Make make) {
    Points points(20240607);
    double worst = 0;
    Pair at;
    for (int i = 0; i < kArguments; ++i) {
        const Pair p = make(points);
        Real result;
        exact(result.get(), p.first, p.second);
        const double error = ulps(f(p.first, p.second), result);
        if (error > worst) {
            worst = error;
            at = p;
        }
    }
    EXPECT_LE(worst, bound) << std::hexfloat << "at " << at.first << ", " << at.second;
    EXPECT_GT(worst, 0) << "nothing was measured";
}

using Unary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_rnd_t);
using Binary = int (*)(mpfr_ptr, mpfr_srcptr, mpfr_srcptr, mpfr_rnd_t);
using OfCircle = int (*)(mpfr_ptr, mpfr_srcptr, unsigned long, mpfr_rnd_t);

template <class Make>
void expect_unary(double bound, double (*f)(double), Unary exact, Make make) {
    expect_error_below(
        bound, [=](double a, double) { return f(a); },
        [=](mpfr_ptr result, double a, double) { exact(result, Real(a).get(), MPFR_RNDN); },
        [=](Points& p) {
            return Pair{make(p), 0};
        });
}

template <class Make>
void expect_binary(double bound, double (*f)(double, double), Binary exact, Make make) {
    expect_error_below(
        bound, f,
        [=](mpfr_ptr result, double a, double b) {
            exact(result, Real(a).get(), Real(b).get(), MPFR_RNDN);
        },
        make);
}

template <class Make>
void expect_degrees(double bound, double (*f)(double), OfCircle exact, Make make) {
    expect_error_below(
        bound, [=](double a, double) { return f(a); },
        [=](mpfr_ptr result, double a, double) { exact(result, Real(a).get(), 360, MPFR_RNDN); },
        [=](Points& p) {
            return Pair{make(p), 0};
        });
}

auto between(double low, double high) {
    return [=](Points& p) { return p.uniform(low, high); };
}
auto any_size(int low, int high) {
    return [=](Points& p) { return p.any_size(low, high); };
}
auto positive(int low, int high) {
    return [=](Points& p) { return std::fabs(p.any_size(low, high)); };
}
// At and around `place`, at every distance.
auto near(double place) {
    return [=](Points& p) { return place + p.any_size(-54, -2); };
}
// The doubles next to multiples of pi / 2, where the reduction cancels.
double near_quarter_turn(Points& p) {
    const double turns = std::floor(p.uniform(-6.8e8, 6.8e8));
    return std::nextafter(turns * 0x1.921fb54442d18p+0, (p.bits() & 1) != 0 ? 1e300 : -1e300);
}

TEST(Transcendental, SinIsWithin053Ulp) {
    expect_unary(0.53, sin, mpfr_sin, between(-10, 10));
    expect_unary(0.53, sin, mpfr_sin, any_size(-1022, 30));
    expect_unary(0.53, sin, mpfr_sin, any_size(10, 30));
    expect_unary(0.53, sin, mpfr_sin, near_quarter_turn);
}

TEST(Transcendental, CosIsWithin053Ulp) {
    expect_unary(0.53, cos, mpfr_cos, between(-10, 10));
    expect_unary(0.53, cos, mpfr_cos, any_size(-30, 30));
    expect_unary(0.53, cos, mpfr_cos, near_quarter_turn);
}

TEST(Transcendental, TanIsWithin055Ulp) {
    expect_unary(0.55, tan, mpfr_tan, between(-10, 10));
    expect_unary(0.55, tan, mpfr_tan, any_size(-1022, 30));
    expect_unary(0.55, tan, mpfr_tan, near_quarter_turn);
}

TEST(Transcendental, SinOfDegreesIsWithin053UlpAtAnySize) {
    expect_degrees(0.53, sin_degrees, mpfr_sinu, between(-1000, 1000));
    expect_degrees(0.53, sin_degrees, mpfr_sinu, near(180));
    expect_degrees(0.53, sin_degrees, mpfr_sinu, any_size(-1000, 100));
    expect_degrees(0.53, sin_degrees, mpfr_sinu, any_size(40, 300));
    expect_degrees(0.76, sin_degrees, mpfr_sinu, any_size(-1074, -1000));
}

TEST(Transcendental, CosOfDegreesIsWithin053UlpAtAnySize) {
    expect_degrees(0.53, cos_degrees, mpfr_cosu, between(-1000, 1000));
    expect_degrees(0.53, cos_degrees, mpfr_cosu, near(270));
    expect_degrees(0.53, cos_degrees, mpfr_cosu, any_size(-20, 100));
    expect_degrees(0.53, cos_degrees, mpfr_cosu, any_size(40, 300));
}

TEST(Transcendental, Atan2IsWithin0501Ulp) {
    const auto exact = mpfr_atan2;
    expect_binary(0.501, atan2, exact, [](Points& p) {
        return Pair{p.uniform(-1, 1), p.uniform(-1, 1)};
    });
    expect_binary(0.501, atan2, exact, [](Points& p) { // every octant's edge, every ratio
        const double x = p.any_size(-900, 900);
        return Pair{x * p.any_size(-64, 64), x};
    });
    expect_binary(0.501, atan2, exact, [](Points& p) { // results are normal: y beyond 2^-1000 x
        return Pair{p.any_size(-500, 1023), p.any_size(-1074, 500)};
    });
    expect_binary(0.501, atan2, exact, [](Points& p) { // subnormal arguments
        return Pair{p.any_size(-1074, -1020), p.any_size(-1074, -1020)};
    });
}

TEST(Transcendental, AcosIsWithin0501Ulp) {
    expect_unary(0.501, acos, mpfr_acos, between(-1, 1));
    expect_unary(0.501, acos, mpfr_acos, any_size(-1074, 0));
    expect_unary(0.501, acos, mpfr_acos,
                 [](Points& p) { return 1 - std::fabs(p.any_size(-53, -1)); });
    expect_unary(0.501, acos, mpfr_acos,
                 [](Points& p) { return std::fabs(p.any_size(-53, -1)) - 1; });
}

TEST(Transcendental, Exp2IsWithin053Ulp) {
    expect_unary(0.53, exp2, mpfr_exp2, between(-1022, 1024));
    expect_unary(0.53, exp2, mpfr_exp2, any_size(-1074, 9));
    expect_unary(0.76, exp2, mpfr_exp2, between(-1076, -1022)); // subnormal: rounded twice
}

TEST(Transcendental, Log2IsWithin0501Ulp) {
    expect_unary(0.501, log2, mpfr_log2, positive(-1074, 1023));
    expect_unary(0.501, log2, mpfr_log2, between(0.5, 2));
    expect_unary(0.501, log2, mpfr_log2, near(1));
}

TEST(Transcendental, PowIsWithin053UlpOverTheWholeRangeOfResults) {
    // base^exponent = 2^r for r over the normal range, for bases of all sizes and next to 1
    const auto of = [](Points& p, double base) {
        const double log = std::log2(base);
        return Pair{base, p.uniform(-1022, 1024) / (log == 0 ? 1 : log)};
    };
    expect_binary(0.53, pow, mpfr_pow,
                  [&](Points& p) { return of(p, std::fabs(p.any_size(-1074, 1023))); });
    expect_binary(0.53, pow, mpfr_pow, [&](Points& p) { return of(p, near(1)(p)); });
    expect_binary(0.53, pow, mpfr_pow, [](Points& p) { return Pair{p.unit(), p.uniform(-3, 10)}; });
    expect_binary(0.53, pow, mpfr_pow, [](Points& p) {
        return Pair{p.unit(), p.any_size(-300, 0)};
    });
}

TEST(Transcendental, CbrtIsWithin0501Ulp) {
    expect_unary(0.501, cbrt, mpfr_cbrt, any_size(-1074, 1023));
    expect_unary(0.501, cbrt, mpfr_cbrt, between(-8, 8));
}

TEST(Transcendental, SqrtIsTheNearestDouble) {
    expect_unary(0.5, sqrt, mpfr_sqrt, positive(-1074, 1023));
}

TEST(Transcendental, RadiansAndDegreesAreWithin0501Ulp) {
    const auto to_radians = [](mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t mode) {
        mpfr_const_pi(r, mode);
        mpfr_mul(r, r, x, mode);
        return mpfr_div_ui(r, r, 180, mode);
    };
    const auto to_degrees = [](mpfr_ptr r, mpfr_srcptr x, mpfr_rnd_t mode) {
        mpfr_const_pi(r, mode);
        mpfr_div(r, x, r, mode);
        return mpfr_mul_ui(r, r, 180, mode);
    };
    expect_unary(0.501, radians, to_radians, any_size(-1016, 1023));
    expect_unary(0.501, degrees, to_degrees, any_size(-1022, 1016));
    expect_unary(0.76, radians, to_radians, any_size(-1074, -1016));
    expect_unary(0.76, degrees, to_degrees, any_size(-1074, -1022));
}

} // namespace
} // namespace scanout::test
