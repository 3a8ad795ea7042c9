// The transcendentals in lanes against MPFR on the best target, and every target against that one:
// bit for bit.
#include "math/lane_functions.h"
#include "oracle.h"
#include "support/targets.h"

#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

constexpr float kInf32 = std::numeric_limits<float>::infinity();
constexpr float kNaN32 = std::numeric_limits<float>::quiet_NaN();

float float_of(std::uint32_t bits) {
    return std::bit_cast<float>(bits);
}

// The same value: the bits, which NaN has too.
bool same(const Floats& a, const Floats& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

TEST(LaneTranscendentals, Log2IsWithin15Ulp) {
    Floats points;
    for (std::uint32_t bits = 0x00800000; bits < 0x7f800000; bits += 5011)
        points.push_back(float_of(bits));
    for (std::uint32_t bits = 0x3f000000; bits < 0x40000000; bits += 53) // [1/2, 2): around log2 1
        points.push_back(float_of(bits));
    for (std::uint32_t step = 0; step < 20000; ++step) { // the floats next to 1
        points.push_back(float_of(0x3f800000 + step));
        points.push_back(float_of(0x3f800000 - step));
    }
    const Floats logs = log2_lanes(points);
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        Real exact(points[i]);
        mpfr_log2(exact.get(), exact.get(), MPFR_RNDN);
        worst = std::max(worst, ulps(logs[i], exact, 24, -126));
    }
    EXPECT_LE(worst, 1.5);
    EXPECT_GT(worst, 0.5);
    RecordProperty("worst", testing::PrintToString(worst));
}

TEST(LaneTranscendentals, Exp2IsWithin12Ulp) {
    Points random(1);
    Floats points;
    for (int i = 0; i < 400000; ++i)
        points.push_back(
            static_cast<float>((i & 1) != 0 ? random.uniform(-126, 128) : random.any_size(-60, 6)));
    const Floats powers = exp2_lanes(points);
    double worst = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        Real exact(points[i]);
        mpfr_exp2(exact.get(), exact.get(), MPFR_RNDN);
        worst = std::max(worst, ulps(powers[i], exact, 24, -126));
    }
    EXPECT_LE(worst, 1.2);
    EXPECT_GT(worst, 0.5);
    RecordProperty("worst", testing::PrintToString(worst));
}

TEST(LaneTranscendentals, PowOfAHighlightIsWithin2ToTheMinus23) {
    Points random(2);
    Floats bases, exponents;
    for (int i = 0; i < 400000; ++i) {
        const auto exponent = static_cast<float>(std::pow(10.0, random.uniform(-3, 4)));
        // Bases over [0, 1], and those whose powers are neither 0 nor 1.
        const double power = random.unit();
        const auto base =
            static_cast<float>((i & 1) != 0 ? random.unit() : std::pow(power, 1.0 / exponent));
        if (base < std::numeric_limits<float>::min()) continue; // counts as 0
        bases.push_back(base);
        exponents.push_back(exponent);
    }
    const Floats powers = pow_lanes(bases, exponents);
    double worst = 0;
    std::size_t worst_at = 0;
    for (std::size_t i = 0; i < bases.size(); ++i) {
        Real exact(bases[i]);
        mpfr_pow(exact.get(), exact.get(), Real(exponents[i]).get(), MPFR_RNDN);
        mpfr_sub_d(exact.get(), exact.get(), powers[i], MPFR_RNDN);
        const double error = std::fabs(exact.nearest());
        if (error <= worst) continue;
        worst = error;
        worst_at = i;
    }
    EXPECT_LT(worst, 0x1p-23) << bases[worst_at] << "^" << exponents[worst_at];
    EXPECT_GT(worst, 0x1p-30);
    RecordProperty("worst", testing::PrintToString(worst));
}

TEST(LaneTranscendentals, Atan2IsWithin3UlpInEveryQuadrant) {
    Points random(3);
    Floats y, x;
    for (int i = 0; i < 300000; ++i) {
        y.push_back(
            static_cast<float>(i % 2 == 0 ? random.uniform(-1, 1) : random.any_size(-30, 30)));
        x.push_back(
            static_cast<float>(i % 3 == 0 ? random.any_size(-30, 30) : random.uniform(-1, 1)));
        if (i % 7 == 0) x.back() = -x.back();
        if (i % 5 == 0) y.back() = -y.back();
    }
    const Floats angles = atan2_lanes(y, x);
    double worst = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        Real exact(y[i]);
        mpfr_atan2(exact.get(), exact.get(), Real(x[i]).get(), MPFR_RNDN);
        worst = std::max(worst, ulps(angles[i], exact, 24, -126));
    }
    EXPECT_LE(worst, 3);
    EXPECT_GT(worst, 0.5);
    RecordProperty("worst", testing::PrintToString(worst));
    on_every_target([&](const std::string&) {
        EXPECT_TRUE(same(atan2_lanes(y, x), angles));
        const float pi = 0x1.921fb6p+1F;
        EXPECT_EQ(atan2_lanes({0, 0, 1, -1, 0, 1, -1}, {0, 1, 0, 0, -1, 1, -1}),
                  (Floats{0, 0, pi / 2, -pi / 2, pi, pi / 4, -(pi - pi / 4)}));
    });
}

TEST(LaneTranscendentals, PowersOfTwoAreExact) {
    Floats whole, powers;
    for (int i = -126; i <= 127; ++i) {
        whole.push_back(static_cast<float>(i));
        powers.push_back(static_cast<float>(std::ldexp(1.0, i)));
    }
    on_every_target([&](const std::string&) {
        EXPECT_EQ(exp2_lanes(whole), powers);
        EXPECT_EQ(log2_lanes(powers), whole);
    });
}

TEST(LaneTranscendentals, PowIsMonotoneEnoughToStayIn0To1) {
    Floats bases;
    for (std::uint32_t bits = 0; bits <= 0x3f800000; bits += 1009)
        bases.push_back(float_of(bits));
    for (const float y : {0.0F, 1e-6F, 0.5F, 1.0F, 2.0F, 50.0F, 1000.0F, 10000.0F})
        for (const float power : pow_lanes(bases, Floats(bases.size(), y)))
            ASSERT_TRUE(power >= 0 && power <= 1) << power << " for exponent " << y;
    EXPECT_EQ(pow_lanes({1}, {10000}), Floats{1});
}

TEST(LaneTranscendentals, PowersOfSharesHaveTheBitsOfThoseOfAnyNumber) {
    Floats shares;
    for (std::uint32_t bits = 0; bits <= 0x3f800000; bits += 1009)
        shares.push_back(float_of(bits));
    for (std::uint32_t bits = 0x3f700000; bits <= 0x3f800000; ++bits) // highlights
        shares.push_back(float_of(bits));
    shares.insert(shares.end(), {1.0F, -0.0F, 0x1p-127F, 0x1p-126F, -1.0F, -kInf32, kNaN32});
    on_every_target([&](const std::string&) {
        for (const float y : {0.0F, 1e-6F, 0.4F, 1.0F, 2.0F, 32.0F, 126.0F, 1000.0F, 10000.0F}) {
            const Floats exponents(shares.size(), y);
            EXPECT_TRUE(same(pow_of_share_lanes(shares, exponents), pow_lanes(shares, exponents)));
        }
    });
}

TEST(LaneTranscendentals, NothingOutsideTheDomainGivesNaN) {
    const auto all = [](const Floats& got, float expected) {
        for (std::size_t i = 0; i < got.size(); ++i)
            EXPECT_EQ(got[i], expected) << "lane " << i;
    };
    on_every_target([&](const std::string&) {
        all(log2_lanes({0.0F, -0.0F, -1.0F, 0x1p-127F, -kInf32, kNaN32, -kNaN32}), -kInf32);
        all(log2_lanes({kInf32}), kInf32);
        all(log2_lanes({1}), 0.0F);
        all(exp2_lanes({-0x1.f80002p6F, -1000.0F, -3e38F, -kInf32, kNaN32, -kNaN32}), 0.0F);
        all(exp2_lanes({128.0F, 1000.0F, 3e38F, kInf32}), kInf32);
        all(exp2_lanes({-126}), 0x1p-126F);
        EXPECT_LT(exp2_lanes({0x1.fffffep6F})[0], kInf32);
        const Floats bad = {0.0F, -0.0F, -2.0F, -kInf32, kNaN32};
        all(pow_lanes(bad, Floats(bad.size(), 2)), 0.0F);
        all(pow_lanes(bad, Floats(bad.size(), 0)), 1.0F);
        all(pow_lanes({0.5F}, {kNaN32}), 0.0F);
    });
}

TEST(LaneTranscendentals, EveryTargetGivesTheSameBits) {
    Floats x, y;
    for (std::uint64_t bits = 0; bits <= 0xffffffff; bits += 4099)
        x.push_back(float_of(static_cast<std::uint32_t>(bits)));
    for (std::uint32_t bits = 0x3f000000; bits <= 0x3f800000; bits += 17) // highlights
        x.push_back(float_of(bits));
    for (std::size_t i = 0; i < x.size(); ++i)
        y.push_back(static_cast<float>(i % 10007) * 0.25F);
    const Floats logs = log2_lanes(x), powers = exp2_lanes(x), general = pow_lanes(x, y);
    for (const float value : general)
        ASSERT_FALSE(std::isnan(value));
    on_every_target([&](const std::string&) {
        EXPECT_TRUE(same(log2_lanes(x), logs));
        EXPECT_TRUE(same(exp2_lanes(x), powers));
        EXPECT_TRUE(same(pow_lanes(x, y), general));
    });
}

} // namespace
} // namespace scanout::test
