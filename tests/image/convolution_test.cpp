// Low-pass and high-pass: what they promise of planes, and of pictures.
#include "image/convolution.h"
#include "pictures.h"
#include "rows.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace scanout::image {
namespace {

using test::random_picture;

Plane noise(int width, int height) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    Plane plane(width, height);
    for (double& v : plane.value)
        v = unit(random);
    return plane;
}

double spread(const Plane& plane) { // of neighbours
    double sum = 0;
    for (int y = 0; y < plane.height; ++y)
        for (int x = 1; x < plane.width; ++x)
            sum += std::abs(plane.at(x, y) - plane.at(x - 1, y));
    return sum;
}

Plane low_of(Plane plane) {
    Plane between;
    low_pass(plane, between);
    return plane;
}

Plane high_of(Plane plane) {
    Plane low, between;
    high_pass(plane, low, between);
    return plane;
}

// In room that a larger picture has left.
Image convolved(std::string_view name, Image picture) {
    std::vector<Plane> room(7, noise(60, 50));
    find_row(image::convolution::kRows, name)->run(picture, room);
    return picture;
}

TEST(LowPass, AndHighPassTogetherAreThePlane) {
    const Plane plane = noise(40, 30), low = low_of(plane), high = high_of(plane);
    for (std::size_t i = 0; i < plane.value.size(); ++i)
        ASSERT_NEAR(low.value[i] + high.value[i], plane.value[i], 1e-15);
    EXPECT_LT(spread(low), spread(plane) / 3);
    EXPECT_GT(spread(high), spread(plane) / 2);
}

TEST(LowPass, KeepsAConstantAndASlopeAndHighPassMakesThemNothing) {
    Plane flat(20, 20), slope(20, 20);
    std::fill(flat.value.begin(), flat.value.end(), 0.1);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x)
            slope.at(x, y) = 3 * x - 2 * y;
    EXPECT_EQ(low_of(flat).value, flat.value);
    for (const double rest : high_of(flat).value)
        ASSERT_EQ(rest, 0);
    for (int y = 2; y < 18; ++y) // away from the repeated edge
        for (int x = 2; x < 18; ++x)
            ASSERT_NEAR(low_of(slope).at(x, y), slope.at(x, y), 1e-12);
}

TEST(LowPass, TakesTheFinestStripesAwayWhole) {
    Plane stripes(32, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 32; ++x)
            stripes.at(x, y) = x % 2;
    const Plane low = low_of(stripes); // 1 - 4 + 6 - 4 + 1 = 0
    for (int y = 0; y < 8; ++y)
        for (int x = 2; x < 30; ++x)
            ASSERT_NEAR(low.at(x, y), 0.5, 1e-15);
}

TEST(Convolutions, KeepOrBlackenAFlatPicture) {
    const Image flat(9, 7, {200, 3, 77, 128});
    EXPECT_EQ(convolved("low_pass", flat), flat);
    EXPECT_EQ(convolved("high_pass", flat), Image(9, 7, {0, 0, 0, 255}));
    EXPECT_EQ(find_row(image::convolution::kRows, "band_pass"), nullptr);
    for (const Convolution* convolution : image::convolution::kRows)
        EXPECT_TRUE(convolved(convolution->card.name, Image()).empty());
}

TEST(Convolutions, SmoothInLightAndLetTransparentPixelsCountForNothing) {
    // Half black, half white: far from the edge nothing changes, and on it light is halved, 188.
    Image halves(20, 9, {0, 0, 0, 255});
    for (int y = 0; y < 9; ++y)
        for (int x = 10; x < 20; ++x)
            halves.at(x, y) = {255, 255, 255, 255};
    const Image smooth = convolved("low_pass", halves);
    EXPECT_EQ(smooth.at(3, 4).r, 0);
    EXPECT_EQ(smooth.at(16, 4).r, 255);
    EXPECT_EQ(smooth.at(9, 4).r, 152);  // 5/16 of light
    EXPECT_EQ(smooth.at(10, 4).r, 216); // 11/16
    // Red glass beside nothing: its colour is not darkened by what stands under alpha 0.
    Image glass(20, 9, {0, 255, 0, 0});
    for (int y = 0; y < 9; ++y)
        for (int x = 10; x < 20; ++x)
            glass.at(x, y) = {255, 0, 0, 200};
    const Rgba8 edge = convolved("low_pass", glass).at(9, 4);
    EXPECT_EQ(edge.r, 255);
    EXPECT_EQ(edge.g, 0);
    EXPECT_EQ(edge.a, 63); // 5/16 of 200, rounded
}

} // namespace
} // namespace scanout::image
