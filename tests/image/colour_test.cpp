// Colour spaces: round trips, their landmarks, and the formulas of the standards in libm's
// arithmetic.
#include "image/colour.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace scanout::image {
namespace {

double far(const DVec3& a, const DVec3& b) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}

DVec3 any_colour(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    return {unit(random), unit(random), unit(random)};
}

TEST(Hsv, OfEveryColourLeadsBackToIt) {
    std::mt19937 random(1);
    for (int i = 0; i < 100000; ++i) {
        const DVec3 rgb = any_colour(random);
        const Hsv hsv = to_hsv(rgb);
        ASSERT_GE(hsv.hue, 0);
        ASSERT_LT(hsv.hue, 360);
        ASSERT_GE(hsv.saturation, 0);
        ASSERT_LE(hsv.saturation, 1);
        ASSERT_LT(far(from_hsv(hsv), rgb), 1e-14);
    }
}

TEST(Hsv, HasItsLandmarks) {
    const auto expect = [](const DVec3& rgb, const Hsv& hsv) {
        const Hsv got = to_hsv(rgb);
        EXPECT_EQ(got.hue, hsv.hue);
        EXPECT_EQ(got.saturation, hsv.saturation);
        EXPECT_EQ(got.value, hsv.value);
        EXPECT_EQ(far(from_hsv(hsv), rgb), 0);
    };
    expect({0, 0, 0}, {0, 0, 0});
    expect({1, 1, 1}, {0, 0, 1});
    expect({1, 0, 0}, {0, 1, 1});
    expect({1, 1, 0}, {60, 1, 1});
    expect({0, 1, 0}, {120, 1, 1});
    expect({0, 1, 1}, {180, 1, 1});
    expect({0, 0, 1}, {240, 1, 1});
    expect({1, 0, 1}, {300, 1, 1});
    expect({0.5, 0.25, 0.25}, {0, 0.5, 0.5});
    // Round the circle, either way.
    EXPECT_LT(far(from_hsv({-120, 1, 1}), {0, 0, 1}), 1e-12);
    EXPECT_LT(far(from_hsv({3600 + 60, 1, 1}), {1, 1, 0}), 1e-12);
}

TEST(Hsv, HasAHueThatTurnsBySectorsAsSmithsDoes) {
    std::mt19937 random(2);
    for (int i = 0; i < 10000; ++i) {
        const DVec3 rgb = any_colour(random);
        // Hue as an angle round the grey axis by another way: sorted channels.
        const double high = std::max({rgb.x, rgb.y, rgb.z}), low = std::min({rgb.x, rgb.y, rgb.z});
        const double middle = rgb.x + rgb.y + rgb.z - high - low;
        const double along = (middle - low) / (high - low);
        const bool r = rgb.x == high, g = !r && rgb.y == high;
        const double sextant = r   ? (rgb.z == low ? along : 6 - along)
                               : g ? (rgb.x == low ? 2 + along : 2 - along)
                                   : (rgb.y == low ? 4 + along : 4 - along);
        EXPECT_NEAR(to_hsv(rgb).hue, 60 * sextant, 1e-9);
    }
}

// CIE 2004, with the matrix of IEC 1999 by its chromaticities and pow() of libm.
Lab lab_of_the_standard(const DVec3& c) {
    const double x = 0.4124 * c.x + 0.3576 * c.y + 0.1805 * c.z;
    const double y = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
    const double z = 0.0193 * c.x + 0.1192 * c.y + 0.9505 * c.z;
    const auto f = [](double t) {
        return t > 216.0 / 24389 ? std::pow(t, 1 / 3.0) : (24389.0 / 27 * t + 16) / 116;
    };
    const double fx = f(x / 0.9505), fy = f(y), fz = f(z / 1.0890);
    return {116 * fy - 16, 500 * (fx - fy), 200 * (fy - fz)};
}

TEST(Lab, IsThatOfTheStandardToTheDigitsOfItsMatrix) {
    std::mt19937 random(3);
    for (int i = 0; i < 20000; ++i) {
        DVec3 c = any_colour(random);
        if (i % 2 == 0) c = c * 0.01; // the straight part, too
        const Lab got = to_lab(c), expected = lab_of_the_standard(c);
        ASSERT_NEAR(got.lightness, expected.lightness, 0.02);
        ASSERT_NEAR(got.a, expected.a, 0.05);
        ASSERT_NEAR(got.b, expected.b, 0.05);
    }
}

TEST(Lab, HasItsLandmarks) {
    const Lab white = to_lab(DVec3(1)), black = to_lab(DVec3(0)), red = to_lab({1, 0, 0});
    EXPECT_NEAR(white.lightness, 100, 1e-12);
    EXPECT_NEAR(white.a, 0, 1e-12);
    EXPECT_NEAR(white.b, 0, 1e-12);
    EXPECT_NEAR(black.lightness, 0, 1e-12);
    EXPECT_NEAR(to_lab(DVec3(0.18418651851244416)).lightness, 50, 1e-9); // middle grey
    EXPECT_NEAR(red.lightness, 53.24, 0.01);
    EXPECT_NEAR(red.a, 80.09, 0.01);
    EXPECT_NEAR(red.b, 67.20, 0.01);
}

TEST(Lab, LeadsBackToTheColourInsideTheGamutAndBeyond) {
    std::mt19937 random(4);
    for (int i = 0; i < 20000; ++i) {
        const DVec3 c = any_colour(random) * 3.0 - DVec3(1);
        ASSERT_LT(far(from_lab(to_lab(c)), c), 1e-12);
        ASSERT_LT(far(from_xyz(to_xyz(c)), c), 1e-14);
    }
    EXPECT_LT(far(to_xyz(DVec3(1)), kWhite), 1e-15);
}

TEST(Lab, GrowsWithLightAndGreysHaveNoColour) {
    double before = -1;
    for (int i = 0; i <= 10000; ++i) {
        const Lab grey = to_lab(DVec3(i / 10000.0));
        ASSERT_GT(grey.lightness, before);
        ASSERT_NEAR(grey.a, 0, 1e-10);
        ASSERT_NEAR(grey.b, 0, 1e-10);
        before = grey.lightness;
    }
}

} // namespace
} // namespace scanout::image
