#include "geom/build.h"
#include "geom/meshes.h"
#include "geom/ruler.h"

#include <cmath>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

namespace scanout::geom {
namespace {

// The cube from 1 to 3, in file units.
Mesh cube() {
    Warnings warnings;
    return build_mesh(testing::cube(1, DVec3(2)), {}, "test", warnings).mesh;
}

DVec3 in_file(const Mesh& mesh, const Vec3& p) {
    return DVec3(p) * std::ldexp(1.0, mesh.exponent) + mesh.centre;
}

TEST(Ruler, StepsAreOneTwoOrFiveTimesAPowerOfTen) {
    EXPECT_EQ(round_step(1), 1.0);
    EXPECT_EQ(round_step(1.99), 1.0);
    EXPECT_EQ(round_step(2), 2.0);
    EXPECT_EQ(round_step(4.99), 2.0);
    EXPECT_EQ(round_step(5), 5.0);
    EXPECT_EQ(round_step(9.99), 5.0);
    EXPECT_EQ(round_step(10), 10.0);
    EXPECT_EQ(round_step(0.003), 0.002);
    EXPECT_EQ(round_step(0.05), 0.05);
    EXPECT_EQ(round_step(7e20), 5e20);
    for (double size = 1e-9; size < 1e9; size *= 1.37) {
        const double squares = size / grid_spacing({size, size / 3, 0});
        EXPECT_GE(squares, 8) << size;
        EXPECT_LE(squares, 20.000001) << size;
    }
    EXPECT_EQ(grid_spacing(DVec3(0)), 1.0) << "of a point";
}

TEST(Ruler, TheBoxHasTwelveEdgesBetweenTheEndsOfTheMesh) {
    const Mesh mesh = cube();
    Mesh lines;
    add_box_lines(mesh, lines);
    ASSERT_EQ(lines.lines(), 12U);
    std::set<std::tuple<double, double, double>> corners;
    double length = 0;
    for (std::size_t i = 0; i < 24; i += 2) {
        const DVec3 a = in_file(mesh, lines.position[lines.line_index[i]]),
                    b = in_file(mesh, lines.position[lines.line_index[i + 1]]);
        corners.insert({a.x, a.y, a.z});
        corners.insert({b.x, b.y, b.z});
        EXPECT_EQ((a.x != b.x) + (a.y != b.y) + (a.z != b.z), 1) << "along an axis";
        length += std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z);
    }
    EXPECT_EQ(corners.size(), 8U);
    EXPECT_EQ(length, 24.0);
}

TEST(Ruler, TheGridLiesOnTheGroundAtRoundCoordinatesAndPastTheModel) {
    const Mesh mesh = cube();
    for (int axis = 0; axis < 3; ++axis)
        for (const bool down : {false, true}) {
            Mesh lines;
            add_grid_lines(mesh, {axis, down}, lines);
            const double spacing = grid_spacing(DVec3(2));
            EXPECT_EQ(spacing, 0.2);
            EXPECT_EQ(lines.lines(), 30U); // 0.6 to 3.4, both ways
            for (const Vec3& p : lines.position) {
                const DVec3 at = in_file(mesh, p);
                EXPECT_EQ(at[axis], down ? 3.0 : 1.0);
                for (int k = 0; k < 3; ++k) {
                    EXPECT_NEAR(at[k] / spacing, std::round(at[k] / spacing), 1e-5);
                    EXPECT_TRUE(at[k] > 0.59 && at[k] < 3.41) << at[k];
                }
            }
        }
}

TEST(Ruler, AxesStandAtTheLowestCorner) {
    const Mesh mesh = cube();
    for (int axis = 0; axis < 3; ++axis) {
        Mesh lines;
        add_axis_line(mesh, axis, lines);
        ASSERT_EQ(lines.lines(), 1U);
        const DVec3 a = in_file(mesh, lines.position[0]), b = in_file(mesh, lines.position[1]);
        for (int k = 0; k < 3; ++k) {
            EXPECT_EQ(a[k], 1.0);
            EXPECT_EQ(b[k] > 1, k == axis);
        }
    }
}

TEST(Ruler, PointsAreThePlacesOfFacesAndNormalsTheDirectionsThere) {
    PolygonMesh polygons = testing::cube(1, DVec3(2), kSmoothingOff);
    polygons.positions.emplace_back(1.5, 1.5, 1.5); // of no face
    Warnings warnings;
    const Mesh mesh = build_mesh(std::move(polygons), {}, "test", warnings).mesh;
    Mesh out;
    add_vertex_points(mesh, out);
    EXPECT_EQ(out.points(), 8U) << "though each is a vertex of three faces";
    Mesh lines;
    add_normal_lines(mesh, lines);
    ASSERT_EQ(lines.lines(), 24U);
    for (std::size_t i = 0; i < lines.line_index.size(); i += 2) {
        const Vec3 a = lines.position[lines.line_index[i]],
                   b = lines.position[lines.line_index[i + 1]];
        EXPECT_NEAR(length(DVec3(b - a)), mesh.radius / 16, 1e-6);
        EXPECT_GT(dot3(DVec3(b - a), DVec3(a)), 0) << "outward";
    }
}

} // namespace
} // namespace scanout::geom
