// Exact results, C99 Annex F's special values, and laws that an error bound does not imply.
#include "math/bits.h"
#include "math/exp_log.h"
#include "math/transcendental.h"
#include "oracle.h"

#include <bit>
#include <cmath> // puts ::sin beside ours: the names must still be ours
#include <type_traits>

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

constexpr double kInf64 = kInfinity;
constexpr double kLeast = 0x1p-1074;
constexpr double kGreatest = 0x1.fffffffffffffp1023;

// Equal, with the sign of zero; any NaN equals kNaN's bits alone.
::testing::AssertionResult same(double got, double want) {
    if (std::bit_cast<std::uint64_t>(got) == std::bit_cast<std::uint64_t>(want))
        return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << std::hexfloat << got << " instead of " << want;
}

TEST(Transcendental, UnqualifiedNamesInOurNamespaceAreOurs) {
    EXPECT_TRUE(same(sin(0x1p31), kNaN)); // libm's sin has no limit
    EXPECT_TRUE((std::is_same_v<decltype(sqrt(1.0F)), double>));
    EXPECT_TRUE((std::is_same_v<decltype(&atan2), double (*)(double, double)>));
}

TEST(Transcendental, MultiplesOf90DegreesAreExactAtAnySize) {
    for (const double turn : {0.0, 360.0, 3600000.0, 360.0 * 0x1p44, 360.0 * 0x1p300}) {
        EXPECT_TRUE(same(sin_degrees(turn), 0.0)) << turn;
        EXPECT_TRUE(same(cos_degrees(turn), 1.0)) << turn;
        EXPECT_TRUE(same(sin_degrees(-turn), -0.0)) << turn;
        if (turn > 1e12) continue;
        EXPECT_TRUE(same(sin_degrees(turn + 90), 1.0));
        EXPECT_TRUE(same(cos_degrees(turn + 90), 0.0));
        EXPECT_TRUE(same(sin_degrees(turn + 180), 0.0));
        EXPECT_TRUE(same(cos_degrees(turn + 180), -1.0));
        EXPECT_TRUE(same(sin_degrees(turn + 270), -1.0));
        EXPECT_TRUE(same(cos_degrees(turn + 270), 0.0));
        EXPECT_TRUE(same(sin_degrees(-turn - 90), -1.0));
        EXPECT_TRUE(same(cos_degrees(-turn - 270), 0.0));
    }
    EXPECT_TRUE(same(sin_degrees(30), 0.5));
    EXPECT_TRUE(same(cos_degrees(60), 0.5));
    EXPECT_TRUE(same(sin_degrees(45), cos_degrees(45)));
}

TEST(Transcendental, ExactResultsAreExact) {
    for (int i = -1074; i <= 1023; ++i) {
        const double power = std::ldexp(1.0, i);
        EXPECT_TRUE(same(log2(power), i));
        EXPECT_TRUE(same(exp2(i), power));
        EXPECT_TRUE(same(pow(2, i), power));
        EXPECT_TRUE(same(pow(0.5, -i), power));
    }
    for (int i = 1; i <= 200000; ++i) {
        const double x = i;
        EXPECT_TRUE(same(cbrt(x * x * x), x));
        EXPECT_TRUE(same(cbrt(-x * x * x), -x));
        EXPECT_TRUE(same(pow(x, 2), x * x));
        EXPECT_TRUE(same(pow(x * x, 0.5), x));
        EXPECT_TRUE(same(pow(x, 1), x));
    }
    EXPECT_TRUE(same(pow(3, 4), 81));
    EXPECT_TRUE(same(pow(10, 22), 1e22));
    EXPECT_TRUE(same(pow(9, -1.5), 1.0 / 27));
    EXPECT_TRUE(same(radians(180), 0x1.921fb54442d18p+1));
    EXPECT_TRUE(same(degrees(0x1.921fb54442d18p+1), 180));
}

TEST(Transcendental, SymmetriesHoldBitForBit) {
    Points points(5);
    for (int i = 0; i < 100000; ++i) {
        const double x = points.any_size(-40, 30);
        const double y = points.any_size(-40, 30);
        EXPECT_TRUE(same(sin(-x), -sin(x)));
        EXPECT_TRUE(same(cos(-x), cos(x)));
        EXPECT_TRUE(same(tan(-x), -tan(x)));
        EXPECT_TRUE(same(atan2(-y, x), -atan2(y, x)));
        EXPECT_TRUE(same(atan2(y * 0x1p500, x * 0x1p500), atan2(y, x)));
        EXPECT_TRUE(same(cbrt(-x), -cbrt(x)));
        EXPECT_TRUE(same(sin_degrees(-x), -sin_degrees(x)));
        EXPECT_TRUE(same(cos_degrees(-x), cos_degrees(x)));
        EXPECT_LE(magnitude(sin(x)), 1);
        EXPECT_LE(magnitude(cos(x)), 1);
    }
}

TEST(Transcendental, SpecialAnglesFollowAnnexF) {
    for (const auto f : {&sin, &cos, &tan, &sin_degrees, &cos_degrees})
        for (const double bad : {kInf64, -kInf64, kNaN, -kNaN})
            EXPECT_TRUE(same(f(bad), kNaN));
    for (const double beyond : {0x1.0000000000001p30, -0x1.0000000000001p30, kGreatest}) {
        EXPECT_TRUE(same(sin(beyond), kNaN));
        EXPECT_TRUE(same(cos(beyond), kNaN));
        EXPECT_TRUE(same(tan(beyond), kNaN));
    }
    for (const double odd : {0.0, -0.0, kLeast, -kLeast, 0x1p-1022, 1e-300}) {
        EXPECT_TRUE(same(sin(odd), odd));
        EXPECT_TRUE(same(tan(odd), odd));
        EXPECT_TRUE(same(cos(odd), 1));
        EXPECT_TRUE(same(cos_degrees(odd), 1));
        EXPECT_TRUE(same(sin_degrees(odd), radians(odd)));
    }
    EXPECT_TRUE(same(sin_degrees(-0.0), -0.0));
}

TEST(Transcendental, SpecialArcsFollowAnnexF) {
    const double pi = 0x1.921fb54442d18p+1;
    for (const double s : {1.0, -1.0}) { // the sign of y
        EXPECT_TRUE(same(atan2(s * 0.0, 0.0), s * 0.0));
        EXPECT_TRUE(same(atan2(s * 0.0, -0.0), s * pi));
        EXPECT_TRUE(same(atan2(s * 0.0, 2), s * 0.0));
        EXPECT_TRUE(same(atan2(s * 0.0, -2), s * pi));
        EXPECT_TRUE(same(atan2(s * 3, 0.0), s * pi / 2));
        EXPECT_TRUE(same(atan2(s * 3, -0.0), s * pi / 2));
        EXPECT_TRUE(same(atan2(s * kInf64, 5), s * pi / 2));
        EXPECT_TRUE(same(atan2(s * kInf64, kInf64), s * pi / 4));
        EXPECT_TRUE(same(atan2(s * kInf64, -kInf64), s * 0.75 * pi));
        EXPECT_TRUE(same(atan2(s * 5, kInf64), s * 0.0));
        EXPECT_TRUE(same(atan2(s * 5, -kInf64), s * pi));
        EXPECT_TRUE(same(atan2(s * kLeast, kGreatest), s * 0.0));
        EXPECT_TRUE(same(atan2(s * kLeast, kLeast), s * pi / 4));
        EXPECT_TRUE(same(atan2(s * kGreatest, kGreatest), s * pi / 4));
        EXPECT_TRUE(same(atan2(s * kGreatest, -kLeast), s * pi / 2));
    }
    EXPECT_TRUE(same(atan2(kNaN, 1), kNaN));
    EXPECT_TRUE(same(atan2(1, -kNaN), kNaN));
    EXPECT_TRUE(same(acos(1), 0.0));
    EXPECT_TRUE(same(acos(-1), pi));
    EXPECT_TRUE(same(acos(0.0), pi / 2));
    EXPECT_TRUE(same(acos(-0.0), pi / 2));
    for (const double bad : {0x1.0000000000001p0, -0x1.0000000000001p0, kInf64, -kInf64, kNaN})
        EXPECT_TRUE(same(acos(bad), kNaN));
}

TEST(Transcendental, SpecialPowersFollowAnnexF) {
    EXPECT_TRUE(same(exp2(kInf64), kInf64));
    EXPECT_TRUE(same(exp2(-kInf64), 0.0));
    EXPECT_TRUE(same(exp2(1024), kInf64));
    EXPECT_TRUE(same(exp2(0x1.fffffffffffffp9), 0x1.ffffffffffd3ap1023)); // the last below 1024
    EXPECT_TRUE(same(exp2(-1075), 0.0));
    EXPECT_TRUE(same(exp2(-1074.5), kLeast));
    EXPECT_TRUE(same(exp2(-kNaN), kNaN));
    EXPECT_TRUE(same(log2(0.0), -kInf64));
    EXPECT_TRUE(same(log2(-0.0), -kInf64));
    EXPECT_TRUE(same(log2(kInf64), kInf64));
    EXPECT_TRUE(same(log2(1), 0.0));
    for (const double bad : {-kLeast, -1.0, -kInf64, kNaN})
        EXPECT_TRUE(same(log2(bad), kNaN));

    for (const double any : {0.0, -0.0, 1.0, -2.0, kLeast, kInf64, -kInf64, kNaN})
        EXPECT_TRUE(same(pow(any, 0.0), 1)) << any;
    for (const double any : {0.0, 3.5, -7.0, kInf64, -kInf64, kNaN})
        EXPECT_TRUE(same(pow(1, any), 1)) << any;
    EXPECT_TRUE(same(pow(0.0, 2), 0.0));
    EXPECT_TRUE(same(pow(-0.0, 3), 0.0));
    EXPECT_TRUE(same(pow(0.0, -2), kInf64));
    EXPECT_TRUE(same(pow(0.0, kInf64), 0.0));
    EXPECT_TRUE(same(pow(0.5, kInf64), 0.0));
    EXPECT_TRUE(same(pow(0.5, -kInf64), kInf64));
    EXPECT_TRUE(same(pow(2, kInf64), kInf64));
    EXPECT_TRUE(same(pow(2, -kInf64), 0.0));
    EXPECT_TRUE(same(pow(kInf64, 0.1), kInf64));
    EXPECT_TRUE(same(pow(kInf64, -0.1), 0.0));
    EXPECT_TRUE(same(pow(0x1.0000000000001p0, kGreatest), kInf64));
    EXPECT_TRUE(same(pow(0x1.fffffffffffffp-1, kGreatest), 0.0));
    EXPECT_TRUE(same(pow(kGreatest, kLeast), 1));
    EXPECT_TRUE(same(pow(kLeast, 1), kLeast));
    EXPECT_TRUE(same(pow(kGreatest, 1), kGreatest));
    for (const double bad : {-2.0, -kLeast, -kInf64, kNaN})
        EXPECT_TRUE(same(pow(bad, 2), kNaN));
    EXPECT_TRUE(same(pow(2, -kNaN), kNaN));
}

TEST(Transcendental, SpecialRootsAndUnitsFollowAnnexF) {
    for (const auto f : {&cbrt, &radians, &degrees})
        for (const double fixed : {0.0, -0.0, kInf64, -kInf64, kNaN})
            EXPECT_TRUE(same(f(fixed), fixed));
    EXPECT_TRUE(same(cbrt(-kNaN), kNaN));
    EXPECT_TRUE(same(cbrt(kLeast), 0x1p-358));
    EXPECT_TRUE(same(degrees(kGreatest), kInf64));
    EXPECT_TRUE(same(sqrt(-0.0), -0.0));
    EXPECT_TRUE(same(sqrt(kInf64), kInf64));
    EXPECT_TRUE(same(sqrt(-1), kNaN));
    EXPECT_TRUE(same(sqrt(-kNaN), kNaN));
}

// |value - exact| in units of 2^-106 of the exact value.
void expect_table_entry(Dd value, Real& exact) {
    mpfr_sub_d(exact.get(), exact.get(), value.hi, MPFR_RNDN);
    mpfr_sub_d(exact.get(), exact.get(), value.lo, MPFR_RNDN);
    EXPECT_LE(std::fabs(exact.nearest()), magnitude(value.hi) * 0x1p-106);
}

TEST(Transcendental, TablesHoldTheirFunctionsTo106Bits) {
    int i = detail::kLog2First;
    for (const Dd entry : detail::kLog2Table) {
        Real exact(i++ / 32.0);
        mpfr_log2(exact.get(), exact.get(), MPFR_RNDN);
        expect_table_entry(entry, exact);
    }
    EXPECT_EQ(i, 46); // 45 / 32 is nearest to sqrt(2)
    i = 0;
    for (const Dd entry : detail::kExp2Table) {
        Real exact(i++ / 32.0);
        mpfr_exp2(exact.get(), exact.get(), MPFR_RNDN);
        expect_table_entry(entry, exact);
    }
    EXPECT_EQ(i, 32);
}

TEST(Transcendental, TheLogarithmUnderPowHas65Bits) {
    Points points(6);
    double worst = 0;
    for (int i = 0; i < 200000; ++i) {
        const double x =
            (i & 1) != 0 ? std::fabs(points.any_size(-1074, 1023)) : 1 + points.any_size(-50, -1);
        const Dd got = detail::log2_dd(x);
        Real exact(x);
        mpfr_log2(exact.get(), exact.get(), MPFR_RNDN);
        const double size = exact.nearest();
        mpfr_sub_d(exact.get(), exact.get(), got.hi, MPFR_RNDN);
        mpfr_sub_d(exact.get(), exact.get(), got.lo, MPFR_RNDN);
        if (size != 0) worst = std::max(worst, std::fabs(exact.nearest() / size));
    }
    EXPECT_LT(worst, 0x1p-65);
    EXPECT_GT(worst, 0);
}

} // namespace
} // namespace scanout::test
