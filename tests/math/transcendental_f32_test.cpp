#include "math/transcendental_f32.h"
#include "oracle.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN32 = std::numeric_limits<float>::quiet_NaN();

float float_of(std::uint32_t bits) {
    return std::bit_cast<float>(bits);
}

double log2_ulps(float x) {
    Real exact(x);
    mpfr_log2(exact.get(), exact.get(), MPFR_RNDN);
    return ulps(log2_f32(x), exact, 24, -126);
}

TEST(TranscendentalF32, Log2IsWithin15Ulp) {
    double worst = 0;
    for (std::uint32_t bits = 0x00800000; bits < 0x7f800000; bits += 5011)
        worst = std::max(worst, log2_ulps(float_of(bits)));
    for (std::uint32_t bits = 0x3f000000; bits < 0x40000000; bits += 53) // [1/2, 2): around log2 1
        worst = std::max(worst, log2_ulps(float_of(bits)));
    for (std::uint32_t step = 0; step < 20000; ++step) { // the floats next to 1
        worst = std::max(worst, log2_ulps(float_of(0x3f800000 + step)));
        worst = std::max(worst, log2_ulps(float_of(0x3f800000 - step)));
    }
    EXPECT_LE(worst, 1.5);
    EXPECT_GT(worst, 0.5);
}

TEST(TranscendentalF32, Exp2IsWithin12Ulp) {
    Points points(1);
    double worst = 0;
    for (int i = 0; i < 400000; ++i) {
        const auto x =
            static_cast<float>((i & 1) != 0 ? points.uniform(-126, 128) : points.any_size(-60, 6));
        Real exact(x);
        mpfr_exp2(exact.get(), exact.get(), MPFR_RNDN);
        worst = std::max(worst, ulps(exp2_f32(x), exact, 24, -126));
    }
    EXPECT_LE(worst, 1.2);
    EXPECT_GT(worst, 0.5);
}

TEST(TranscendentalF32, PowOfAHighlightIsWithin2ToTheMinus23) {
    Points points(2);
    double worst = 0;
    float worst_x = 0;
    float worst_y = 0;
    for (int i = 0; i < 400000; ++i) {
        const auto exponent = static_cast<float>(std::pow(10.0, points.uniform(-3, 4)));
        // Bases over [0, 1], and those whose powers are neither 0 nor 1.
        const double power = points.unit();
        const auto base =
            static_cast<float>((i & 1) != 0 ? points.unit() : std::pow(power, 1.0 / exponent));
        if (base < std::numeric_limits<float>::min()) continue; // counts as 0
        Real exact(base);
        mpfr_pow(exact.get(), exact.get(), Real(exponent).get(), MPFR_RNDN);
        mpfr_sub_d(exact.get(), exact.get(), pow_f32(base, exponent), MPFR_RNDN);
        const double error = std::fabs(exact.nearest());
        if (error > worst) {
            worst = error;
            worst_x = base;
            worst_y = exponent;
        }
    }
    EXPECT_LT(worst, 0x1p-23) << worst_x << "^" << worst_y;
    EXPECT_GT(worst, 0x1p-30);
}

TEST(TranscendentalF32, PowersOfTwoAreExact) {
    for (int i = -126; i <= 127; ++i) {
        const auto power = static_cast<float>(std::ldexp(1.0, i));
        EXPECT_EQ(exp2_f32(static_cast<float>(i)), power);
        EXPECT_EQ(log2_f32(power), static_cast<float>(i));
    }
}

TEST(TranscendentalF32, PowIsMonotoneEnoughToStayIn0To1) {
    for (std::uint32_t bits = 0; bits <= 0x3f800000; bits += 1009) {
        const float x = float_of(bits);
        for (const float y : {0.0F, 1e-6F, 0.5F, 1.0F, 2.0F, 50.0F, 1000.0F, 10000.0F}) {
            const float power = pow_f32(x, y);
            EXPECT_GE(power, 0.0F) << x << " " << y;
            EXPECT_LE(power, 1.0F) << x << " " << y;
        }
    }
    EXPECT_EQ(pow_f32(1, 10000), 1.0F);
}

TEST(TranscendentalF32, NothingOutsideTheDomainGivesNaN) {
    for (const float bad : {0.0F, -0.0F, -1.0F, 0x1p-127F, -kInf, kNaN32, -kNaN32})
        EXPECT_EQ(log2_f32(bad), -kInf) << bad;
    EXPECT_EQ(log2_f32(kInf), kInf);
    EXPECT_EQ(log2_f32(1), 0.0F);
    for (const float low : {-0x1.f80002p6F, -1000.0F, -3e38F, -kInf, kNaN32, -kNaN32})
        EXPECT_EQ(exp2_f32(low), 0.0F) << low;
    for (const float high : {128.0F, 1000.0F, 3e38F, kInf})
        EXPECT_EQ(exp2_f32(high), kInf) << high;
    EXPECT_EQ(exp2_f32(-126), 0x1p-126F);
    EXPECT_LT(exp2_f32(0x1.fffffep6F), kInf);
    for (const float bad : {0.0F, -0.0F, -2.0F, -kInf, kNaN32}) {
        EXPECT_EQ(pow_f32(bad, 2), 0.0F) << bad;
        EXPECT_EQ(pow_f32(bad, 0), 1.0F) << bad;
    }
    EXPECT_EQ(pow_f32(0.5F, kNaN32), 0.0F);
}

} // namespace
} // namespace scanout::test
