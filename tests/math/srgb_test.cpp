#include "math/lane_functions.h"
#include "math/srgb.h"
#include "oracle.h"
#include "support/targets.h"

#include <limits>
#include <set>

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

// The formulas of IEC 1999 as Microsoft 2015, 3.2.3.7, writes them; code and the result in codes,
// unrounded.
void exact_decode(Real& linear, double code) {
    Real encoded(code);
    mpfr_div_ui(encoded.get(), encoded.get(), 255, MPFR_RNDN);
    if (code / 255 <= 0.04045) {
        Real slope;
        mpfr_set_str(slope.get(), "12.92", 10, MPFR_RNDN);
        mpfr_div(linear.get(), encoded.get(), slope.get(), MPFR_RNDN);
        return;
    }
    Real offset, exponent;
    mpfr_set_str(offset.get(), "0.055", 10, MPFR_RNDN);
    mpfr_set_str(exponent.get(), "2.4", 10, MPFR_RNDN);
    mpfr_add(linear.get(), encoded.get(), offset.get(), MPFR_RNDN);
    mpfr_add_ui(offset.get(), offset.get(), 1, MPFR_RNDN);
    mpfr_div(linear.get(), linear.get(), offset.get(), MPFR_RNDN);
    mpfr_pow(linear.get(), linear.get(), exponent.get(), MPFR_RNDN);
}

void exact_encode(Real& code, double linear) {
    if (linear <= 0.0031308) {
        Real slope;
        mpfr_set_str(slope.get(), "12.92", 10, MPFR_RNDN);
        mpfr_mul_d(code.get(), slope.get(), linear, MPFR_RNDN);
    } else {
        Real offset, exponent;
        mpfr_set_str(offset.get(), "0.055", 10, MPFR_RNDN);
        mpfr_set_ui(exponent.get(), 5, MPFR_RNDN);
        mpfr_div_ui(exponent.get(), exponent.get(), 12, MPFR_RNDN); // 1 / 2.4
        mpfr_pow(code.get(), Real(linear).get(), exponent.get(), MPFR_RNDN);
        Real factor(1);
        mpfr_add(factor.get(), factor.get(), offset.get(), MPFR_RNDN);
        mpfr_mul(code.get(), code.get(), factor.get(), MPFR_RNDN);
        mpfr_sub(code.get(), code.get(), offset.get(), MPFR_RNDN);
    }
    mpfr_mul_ui(code.get(), code.get(), 255, MPFR_RNDN);
}

double encode_error(float linear) {
    Real code;
    exact_encode(code, linear);
    mpfr_sub_ui(code.get(), code.get(), srgb_encode(linear), MPFR_RNDN);
    return std::fabs(code.nearest());
}

TEST(Srgb, DecodeIsTheCorrectlyRoundedFormula) {
    for (int code = 0; code < 256; ++code) {
        Real linear;
        exact_decode(linear, code);
        EXPECT_EQ(srgb_decode(static_cast<std::uint8_t>(code)),
                  mpfr_get_flt(linear.get(), MPFR_RNDN))
            << code;
    }
    EXPECT_EQ(srgb_decode(0), 0.0F);
    EXPECT_EQ(srgb_decode(255), 1.0F);
}

// HARD-CASES P15, with the next three: 256 of 256 codes round trip, every float is encoded to its
// nearest code, no code is skipped.
TEST(Srgb, EveryCodeSurvivesTheRoundTrip) {
    for (int code = 0; code < 256; ++code)
        EXPECT_EQ(srgb_encode(srgb_decode(static_cast<std::uint8_t>(code))), code);
}

TEST(Srgb, EncodeIsTheNearestCode) {
    double worst = 0;
    for (std::uint32_t bits = 0x38000000; bits <= 0x3f800000; bits += 401) // 2^-15 .. 1
        worst = std::max(worst, encode_error(std::bit_cast<float>(bits)));
    EXPECT_LE(worst, 0.5 + 1e-6);
    EXPECT_GT(worst, 0.499);
    RecordProperty("worst_codes", testing::PrintToString(worst));
}

TEST(Srgb, CodesChangeBetweenTheTwoFloatsAroundTheExactThreshold) {
    for (int code = 1; code < 256; ++code) {
        Real exact;
        exact_decode(exact, code - 0.5);
        const float below = mpfr_get_flt(exact.get(), MPFR_RNDD);
        const float above = mpfr_get_flt(exact.get(), MPFR_RNDU);
        EXPECT_EQ(srgb_encode(below), code - 1);
        EXPECT_EQ(srgb_encode(above), code);
        EXPECT_LE(encode_error(below), 0.5 + 1e-6);
        EXPECT_LE(encode_error(above), 0.5 + 1e-6);
    }
}

TEST(Srgb, EncodeIsMonotoneOverEveryFloatFrom0To1AndReachesEveryCode) {
    std::uint8_t last = 0;
    std::set<int> reached;
    int falls = 0;
    for (std::uint32_t bits = 0; bits <= 0x3f800001; bits += bits < 0x38000000 ? 97 : 1) {
        const std::uint8_t code = srgb_encode(std::bit_cast<float>(bits));
        if (code == last && bits != 0) continue;
        falls += code < last ? 1 : 0;
        last = code;
        reached.insert(code);
    }
    EXPECT_EQ(falls, 0);
    EXPECT_EQ(reached.size(), 256U);
}

TEST(Srgb, EncodeClampsAndTakesNaNFor0) {
    constexpr float kInf = std::numeric_limits<float>::infinity();
    constexpr float kNaN32 = std::numeric_limits<float>::quiet_NaN();
    for (const float low : {0.0F, -0.0F, -1e-30F, -1.0F, -kInf, kNaN32, -kNaN32, 0x1p-149F})
        EXPECT_EQ(srgb_encode(low), 0) << low;
    for (const float high : {1.0F, 1.0000001F, 2.0F, 3e38F, kInf})
        EXPECT_EQ(srgb_encode(high), 255) << high;
}

TEST(Srgb, LanesGiveWhatTheScalarFunctionsGiveOnEveryTarget) {
    // Every code; floats of all kinds; and every float around the thresholds.
    std::vector<std::int32_t> codes(256);
    Floats decoded, linear;
    for (int code = 0; code < 256; ++code) {
        codes[static_cast<std::size_t>(code)] = code;
        decoded.push_back(srgb_decode(static_cast<std::uint8_t>(code)));
    }
    for (std::uint64_t bits = 0; bits <= 0xffffffff; bits += 2003)
        linear.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    for (std::uint32_t bits = 0x38f00000; bits <= 0x3f800010; bits += 127)
        linear.push_back(std::bit_cast<float>(bits));
    for (int code = 1; code < 256; ++code) {
        const auto threshold = std::bit_cast<std::uint32_t>(detail::kSrgb.first_of_code[code]);
        for (std::uint32_t bits = threshold - 2; bits <= threshold + 2; ++bits)
            linear.push_back(std::bit_cast<float>(bits));
    }
    std::vector<std::int32_t> encoded;
    for (const float x : linear)
        encoded.push_back(srgb_encode(x));
    on_every_target([&](const std::string&) {
        EXPECT_EQ(srgb_decode_lanes(codes), decoded);
        EXPECT_TRUE(srgb_encode_lanes(linear) == encoded);
    });
}

} // namespace
} // namespace scanout::test
