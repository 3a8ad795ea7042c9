// The checks of test builds (SCANOUT_CHECK_LANES) fire: a depth that is NaN or infinite ends the
// program with its stage's name, one that nothing shows does not.
#include "raster/check_lanes.h"
#include "raster/exact.h"

#include <limits>

namespace scanout::raster::test {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr image::Rect kPartArea{0, 0, 40, 30}; // less than a tile: the rest of it is dead
const Corners kEverywhere = {{{-64 * 256, -64 * 256}, {256 * 256, 0}, {0, 256 * 256}}};

// Finite as doubles, not as floats; too steep for the path in float.
constexpr std::array<double, 3> kTooSteep = {1e300, 2e300, 4e300};

class RasterLanesDeathTest : public testing::Test {
protected:
    void SetUp() override {
#ifndef SCANOUT_CHECK_LANES
        GTEST_SKIP() << "built without SCANOUT_CHECK_LANES";
#endif
        testing::GTEST_FLAG(death_test_style) = "threadsafe";
    }
};

TEST_F(RasterLanesDeathTest, AVertexThatIsNotFiniteEndsTheProgramAfterTheTransform) {
    for (const double bad : {kNaN, kInf, -kInf}) {
        std::vector<ScreenVertex> vertices(9, ScreenVertex{256, 512, 0.5});
        check_lanes(vertices);
        vertices[7].depth = bad;
        EXPECT_DEATH(check_lanes(vertices), "depth of vertex 7 is -?(nan|inf) after transform");
        vertices[7].x = ScreenVertex::kOffScreen; // to be clipped: its depth means nothing
        check_lanes(vertices);
    }
}

// 0 / 0: no near plane, and a vertex in the eye.
TEST_F(RasterLanesDeathTest, TheGeometryStageLooksAtItsVertices) {
    Jobs jobs(1);
    geom::Mesh mesh;
    add_triangle(mesh, {Vec3(0), Vec3(1, 0, -2), Vec3(0, 1, -2)});
    draw_planes(jobs, mesh, eye_view(1, 1, 0), 64, 64);
    EXPECT_DEATH(draw_planes(jobs, mesh, eye_view(1, 1, 0, 0), 64, 64),
                 "x of vertex 0 is -?nan before it snaps");
}

// The grid saturates, and NaN would stand on it.
TEST_F(RasterLanesDeathTest, AVertexIsLookedAtBeforeItSnaps) {
    for (const double bad : {kNaN, kInf, -kInf}) {
        EXPECT_DEATH(check_before_snap({bad, 20, 1, 2}, 3),
                     "x of vertex 3 is -?(nan|inf) before it snaps");
        EXPECT_DEATH(check_before_snap({10, bad, 1, 2}, 3),
                     "y of vertex 3 is -?(nan|inf) before it snaps");
    }
    // No near plane, and a vertex in the eye: 0 / 0
    const ScreenTransform no_near(eye_view(1, 1, 0, 0), 64, 64);
    no_near.transform(Vec3(0, 0, -2));
    EXPECT_DEATH(no_near.transform(Vec3(0)), "x of vertex 0 is -?nan before it snaps");
    // In lanes: the seventh of nine
    std::vector<Vec3> position(9, Vec3(0, 0, -2));
    std::vector<ScreenVertex> vertices(9);
    transform_vertices(no_near, position, vertices);
    position[6] = Vec3(0);
    EXPECT_DEATH(transform_vertices(no_near, position, vertices),
                 "x of vertex 6 is -?nan before it snaps");
    // Off the screen, nothing snaps.
    position[6] = Vec3(0, 0, 3);
    transform_vertices(no_near, position, vertices);
}

TEST_F(RasterLanesDeathTest, AVertexOfAPieceIsLookedAtBeforeItIsRounded) {
    point_off_screen({10, 20, 1, 2});
    for (const double bad : {kNaN, kInf, -kInf}) {
        EXPECT_DEATH(point_off_screen({bad, 20, 1, 2}),
                     "x of a clipped vertex is -?(nan|inf) before rounding");
        EXPECT_DEATH(point_off_screen({10, bad, 1, 2}),
                     "y of a clipped vertex is -?(nan|inf) before rounding");
        EXPECT_DEATH(point_off_screen({10, 20, 1, bad}),
                     "w of a clipped vertex is -?(nan|inf) before rounding");
    }
}

TEST_F(RasterLanesDeathTest, APrimitiveThatIsNotFiniteEndsTheProgramAfterItsSetUp) {
    VisibilityTile tile;
    tile.reset(kPartArea, 1);
    for (const double bad : {kNaN, kInf, -kInf}) {
        EXPECT_DEATH(tile.draw(set_up(kEverywhere, 5, {0.5, 0.5, bad})),
                     "depth of triangle 5 is -?(nan|inf) after set-up");
        ClippedTriangle clipped{};
        clipped.id = 8;
        clipped.vertex[1].z = bad;
        EXPECT_DEATH(tile.draw_clipped(clipped), "depth of triangle 8 is -?(nan|inf) after set-up");
        clipped.vertex[1].z = 1;
        clipped.vertex[2].depth = bad;
        EXPECT_DEATH(tile.draw_clipped(clipped), "depth of triangle 8 is -?(nan|inf) after set-up");
        EXPECT_DEATH(tile.draw_line(Segment{{0, 9000}, {0, 5000}, {bad, 0.5}, 6}),
                     "depth of line 6 is -?(nan|inf) after set-up");
        EXPECT_DEATH(tile.draw_point(Point{500, 500, bad, 7}),
                     "depth of point 7 is -?(nan|inf) after set-up");
    }
    EXPECT_TRUE(tile.empty());
}

// NaN cannot get here: what is stored is greater than what was.
TEST_F(RasterLanesDeathTest, ADepthThatIsNotFiniteEndsTheProgramAfterCoverage) {
    for (const int samples : {1, 4}) {
        VisibilityTile tile;
        tile.reset(kPartArea, samples);
        tile.draw(set_up(kEverywhere, 3));
        check_lanes(tile);
        tile.draw(set_up(kEverywhere, 4, kTooSteep));
        EXPECT_DEATH(check_lanes(tile), "depth of primitive 4 is inf after coverage");
    }
}

TEST_F(RasterLanesDeathTest, PixelsBeyondATilesAreaAreDead) {
    VisibilityTile tile;
    tile.reset({0, 0, kTileSize, kTileSize}, 1);
    // In pixel (41, 5) alone
    const Corners there = {
        {{41 * 256, 5 * 256}, {42 * 256 + 64, 5 * 256}, {41 * 256, 6 * 256 + 64}}};
    const Triangle infinite = set_up(there, 4, kTooSteep);
    tile.draw(infinite);
    ASSERT_EQ(tile.id(41, 5), 4U);
    EXPECT_DEATH(check_lanes(tile), "primitive 4");
    // The same pixel in a block of eight whose first column is part of the area
    tile.reset({0, 0, 41, 30}, 1);
    const Corners row = {{{40 * 256, 5 * 256}, {43 * 256, 5 * 256}, {40 * 256, 6 * 256 + 128}}};
    tile.draw(set_up(row, 2));
    tile.draw(infinite);
    ASSERT_EQ(tile.id(40, 5), 2U);
    check_lanes(tile);
}

TEST_F(RasterLanesDeathTest, TheGeometryStageLooksAtItsTiles) {
    Jobs jobs(1);
    geom::Mesh mesh;
    add_triangle(mesh, {Vec3(0, 0, 0.5), Vec3(60, 0, 0.5), Vec3(0, 60, 0.5)});
    Geometry geometry;
    geometry.run(jobs, mesh, ScreenTransform(pixel_view(64, 64), 64, 64),
                 {.width = 64, .height = 64});
    VisibilityTile tile;
    tile.reset(geometry.tile_area(0), 1);
    geometry.draw(0, tile);
    EXPECT_FALSE(tile.empty());
    tile.draw(set_up(kEverywhere, 9, kTooSteep));
    EXPECT_DEATH(geometry.draw(0, tile), "depth of primitive 9 is inf after coverage");
}

TEST_F(RasterLanesDeathTest, AnAreaThatIsNotFiniteEndsTheProgram) {
    std::vector<AreaFragment> fragments{{7, 0.5F, 1, 2}, {9, 0.25F, 3, 4}};
    check_lanes(fragments);
    for (const double bad : {kNaN, kInf}) {
        fragments[1].coverage = static_cast<float>(bad);
        EXPECT_DEATH(check_lanes(fragments), "coverage of triangle 9 is (nan|inf) after its area");
    }
}

} // namespace
} // namespace scanout::raster::test
