#include "geom/extent.h"

#include <cmath>

#include <gtest/gtest.h>

namespace scanout::geom {
namespace {

// A box of 2 x 3 x 4 of which a quarter unit is one normalised unit.
Mesh box() {
    Mesh mesh;
    mesh.exponent = -2;
    for (int i = 0; i < 8; ++i)
        mesh.position.emplace_back((i & 1) != 0 ? 4.F : -4.F, (i & 2) != 0 ? 6.F : -6.F,
                                   (i & 4) != 0 ? 8.F : -8.F);
    mesh.index = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                  2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    return mesh;
}

TEST(Extent, OfABoxIsThatOfItsSides) {
    EXPECT_DOUBLE_EQ(*extent_of(box()).area, 2 * (2 * 3 + 2 * 4 + 3 * 4));
    EXPECT_DOUBLE_EQ(*extent_of(box()).volume, 2 * 3 * 4);
}

TEST(Extent, OfABoxWoundInwardsIsANegativeVolume) {
    Mesh mesh = box();
    for (std::size_t i = 0; i < mesh.index.size(); i += 3)
        std::swap(mesh.index[i], mesh.index[i + 1]);
    EXPECT_DOUBLE_EQ(*extent_of(mesh).volume, -24);
    EXPECT_DOUBLE_EQ(*extent_of(mesh).area, 52);
}

// Where the box stands does not matter to a closed surface.
TEST(Extent, DoesNotDependOnThePlace) {
    Mesh mesh = box();
    for (Vec3& place : mesh.position)
        place = place + Vec3(100, -50, 30);
    EXPECT_NEAR(*extent_of(mesh).volume, 24, 1e-12);
}

TEST(Extent, OfNothingIsNothing) {
    EXPECT_FALSE(extent_of(Mesh()).has_area);
    EXPECT_EQ(extent_of(Mesh()).area, 0);
    EXPECT_EQ(extent_of(Mesh()).volume, 0);
}

TEST(Extent, OfAModelBeyondTheRangeOfNumbersHasAnAreaAllTheSame) {
    Mesh mesh = box();
    for (const int exponent : {400, -400}) { // the volume alone
        mesh.exponent = exponent;
        EXPECT_DOUBLE_EQ(*extent_of(mesh).area, std::ldexp(52 * 16, 2 * exponent));
        EXPECT_EQ(extent_of(mesh).volume, std::nullopt);
    }
    for (const int exponent : {600, -600}) {
        mesh.exponent = exponent;
        EXPECT_TRUE(extent_of(mesh).has_area);
        EXPECT_EQ(extent_of(mesh).area, std::nullopt);
        EXPECT_EQ(extent_of(mesh).volume, std::nullopt);
    }
}

} // namespace
} // namespace scanout::geom
