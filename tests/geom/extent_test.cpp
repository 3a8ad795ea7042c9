#include "geom/extent.h"

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
    EXPECT_DOUBLE_EQ(surface_area(box()), 2 * (2 * 3 + 2 * 4 + 3 * 4));
    EXPECT_DOUBLE_EQ(enclosed_volume(box()), 2 * 3 * 4);
}

TEST(Extent, OfABoxWoundInwardsIsANegativeVolume) {
    Mesh mesh = box();
    for (std::size_t i = 0; i < mesh.index.size(); i += 3)
        std::swap(mesh.index[i], mesh.index[i + 1]);
    EXPECT_DOUBLE_EQ(enclosed_volume(mesh), -24);
    EXPECT_DOUBLE_EQ(surface_area(mesh), 52);
}

// Where the box stands does not matter to a closed surface.
TEST(Extent, DoesNotDependOnThePlace) {
    Mesh mesh = box();
    for (Vec3& place : mesh.position)
        place = place + Vec3(100, -50, 30);
    EXPECT_NEAR(enclosed_volume(mesh), 24, 1e-12);
}

TEST(Extent, OfNothingIsNothing) {
    EXPECT_EQ(surface_area(Mesh()), 0);
    EXPECT_EQ(enclosed_volume(Mesh()), 0);
}

} // namespace
} // namespace scanout::geom
