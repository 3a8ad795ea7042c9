#include "geom/build.h"
#include "geom/meshes.h"
#include "geom/section.h"
#include "geom/topology.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <random>
#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace scanout::geom {
namespace {

using testing::jobs;

constexpr double kPi = 3.14159265358979323846;
constexpr std::int32_t kCap = 7;

Mesh built(PolygonMesh polygons) {
    Warnings warnings;
    return build_mesh(std::move(polygons), {}, "test", warnings).mesh;
}

constexpr std::size_t kNoFace = SIZE_MAX;

// `without`: a face that stays out.
void append(PolygonMesh& to, const PolygonMesh& from, bool turned = false,
            std::size_t without = kNoFace) {
    const auto first = static_cast<std::int32_t>(to.positions.size());
    to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
    for (std::size_t f = 0; f < from.faces(); ++f) {
        std::vector<std::int32_t> corners;
        for (std::size_t c = from.face_begin[f]; c < from.face_end(f); ++c)
            corners.push_back(first + from.corners[c].position);
        if (turned) std::reverse(corners.begin(), corners.end());
        if (f != without) testing::add_face(to, corners);
    }
}

PolygonMesh sphere(double radius, const DVec3& centre, int rings = 16) {
    PolygonMesh mesh;
    const int around = 2 * rings;
    for (int i = 1; i < rings; ++i)
        for (int j = 0; j < around; ++j) {
            const double a = kPi * i / rings, b = 2 * kPi * j / around;
            mesh.positions.push_back(centre + radius * DVec3(std::sin(a) * std::cos(b), std::cos(a),
                                                             std::sin(a) * std::sin(b)));
        }
    mesh.positions.push_back(centre + DVec3(0, radius, 0));
    mesh.positions.push_back(centre - DVec3(0, radius, 0));
    const auto at = [&](int i, int j) { return (i - 1) * around + j % around; };
    for (int j = 0; j < around; ++j) {
        testing::add_face(mesh, {(rings - 1) * around, at(1, j + 1), at(1, j)});
        testing::add_face(mesh, {(rings - 1) * around + 1, at(rings - 1, j), at(rings - 1, j + 1)});
        for (int i = 1; i + 1 < rings; ++i)
            testing::add_face(mesh, {at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    }
    return mesh;
}

PolygonMesh torus(double large, double small, int n = 24) {
    PolygonMesh mesh;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double a = 2 * kPi * i / n, b = 2 * kPi * j / n;
            const double r = large + small * std::cos(b);
            mesh.positions.emplace_back(r * std::cos(a), r * std::sin(a), small * std::sin(b));
        }
    const auto at = [&](int i, int j) { return (i % n) * n + j % n; };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            testing::add_face(mesh, {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    return mesh;
}

double volume(const Mesh& mesh, const DVec3& origin) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
        const auto at = [&](std::size_t k) {
            return DVec3(mesh.position[mesh.index[i + k]]) - origin;
        };
        sum += dot3(at(0), cross3(at(1), at(2))) / 6;
    }
    return sum;
}

// What the cut body's volume is: of the triangles' parts behind the plane, as cones to a point on
// it. Caps add nothing to that sum, so it tells nothing of them.
double volume_behind(const Mesh& mesh, const SectionPlane& plane) {
    const DVec3 origin = plane.normal * (plane.offset / dot3(plane.normal, plane.normal));
    double sum = 0;
    for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
        std::vector<DVec3> part;
        for (std::size_t k = 0; k < 3; ++k) {
            const DVec3 a(mesh.position[mesh.index[i + k]]);
            const DVec3 b(mesh.position[mesh.index[i + (k + 1) % 3]]);
            const double of_a = dot3(plane.normal, a) - plane.offset;
            const double of_b = dot3(plane.normal, b) - plane.offset;
            if (of_a <= 0) part.push_back(a - origin);
            if ((of_a > 0) != (of_b > 0))
                part.push_back(a + (b - a) * (of_a / (of_a - of_b)) - origin);
        }
        for (std::size_t k = 2; k < part.size(); ++k)
            sum += dot3(part[0], cross3(part[k - 1], part[k])) / 6;
    }
    return sum;
}

// Edges, by the bits of their ends, that are not used as often one way as the other.
std::size_t unbalanced_edges(const Mesh& mesh) {
    using Place = std::array<float, 3>;
    std::map<std::pair<Place, Place>, int> uses;
    const auto place = [&](std::size_t corner) {
        const Vec3& p = mesh.position[mesh.index[corner]];
        return Place{p.x, p.y, p.z};
    };
    for (std::size_t i = 0; i < mesh.index.size(); i += 3)
        for (std::size_t k = 0; k < 3; ++k) {
            const Place a = place(i + k), b = place(i + (k + 1) % 3);
            if (a != b) uses[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    return static_cast<std::size_t>(
        std::count_if(uses.begin(), uses.end(), [](const auto& use) { return use.second != 0; }));
}

// The body is closed again, and its volume is right, wherever it is cut.
void expect_solid(const Mesh& mesh, const SectionPlane& plane, const std::string& what) {
    const std::optional<Section> found = cut_by_plane(jobs(), mesh, plane, kCap);
    if (!found) return;
    EXPECT_EQ(unbalanced_edges(found->mesh), 0U) << what;
    EXPECT_EQ(found->open_edges, 0U) << what;
    EXPECT_NEAR(volume(found->mesh, DVec3(3, -5, 2)), volume_behind(mesh, plane), 2e-6) << what;
}

PolygonMesh nested_shells() {
    PolygonMesh mesh = sphere(1, DVec3(0));
    append(mesh, sphere(0.6, DVec3(0.1, 0, 0)), true);     // a cavity
    append(mesh, sphere(0.3, DVec3(0.1, 0.1, 0)));         // a ball in it
    append(mesh, sphere(0.1, DVec3(0.7, 0.3, 0.1)), true); // another cavity
    return mesh;
}

TEST(Section, ACubeInHalfIsABoxOfHalfTheVolume) {
    const Mesh mesh = built(testing::cube());
    const auto found = cut_by_plane(jobs(), mesh, {{0, 0, 1}, 0}, kCap);
    ASSERT_TRUE(found);
    EXPECT_DOUBLE_EQ(volume(found->mesh, DVec3(0.3, 2, 5)), volume(mesh, DVec3(0)) / 2);
    EXPECT_EQ(found->removed, 2U);
    EXPECT_EQ(found->cut, 8U);
    EXPECT_EQ(found->caps, 6U); // eight points, four of them on straight sides
    EXPECT_EQ(unbalanced_edges(found->mesh), 0U);
    EXPECT_TRUE(topology(found->mesh).closed);
    EXPECT_EQ(found->mesh.triangles(), 2 + 8 + 4 + found->caps);
    EXPECT_EQ(found->mesh.centre, mesh.centre);
    EXPECT_EQ(found->mesh.radius, mesh.radius);
    for (std::size_t t = 0; t < found->mesh.triangles(); ++t) {
        const bool cap = found->mesh.material[t] == kCap;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = found->mesh.index[3 * t + k];
            EXPECT_LE(found->mesh.position[v].z, 0);
            if (!cap) continue;
            EXPECT_EQ(found->mesh.position[v].z, 0);
            EXPECT_EQ(found->mesh.normal[v], Vec3(0, 0, 1));
        }
    }
}

TEST(Section, APlaneBesideTheModelOrAtItsSideChangesNothing) {
    const Mesh mesh = built(testing::cube());
    const float side = mesh.position[mesh.index[0]].x > 0 ? mesh.position[mesh.index[0]].x
                                                          : -mesh.position[mesh.index[0]].x;
    EXPECT_FALSE(cut_by_plane(jobs(), mesh, {{0, 0, 1}, side}, kCap));
    EXPECT_FALSE(cut_by_plane(jobs(), mesh, {{0, 2, 0}, 5}, kCap));
    const auto all = cut_by_plane(jobs(), mesh, {{0, 0, 1}, -double{side}}, kCap);
    ASSERT_TRUE(all); // the bottom looks away from the plane's front: it goes with the rest
    EXPECT_EQ(all->mesh.triangles(), 0U);
    EXPECT_EQ(all->removed, 12U);
}

TEST(Section, SolidsStaySolidUnderPlanesInAllDirections) {
    const std::pair<const char*, Mesh> bodies[] = {{"cube", built(testing::cube())},
                                                   {"sphere", built(sphere(1, DVec3(0)))},
                                                   {"torus", built(torus(1, 0.4))},
                                                   {"shells", built(nested_shells())}};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> one(-1, 1);
    for (const auto& [name, mesh] : bodies)
        for (int i = 0; i < 60; ++i) {
            const DVec3 normal(one(random), one(random), one(random));
            const double offset = one(random) * std::sqrt(dot3(normal, normal));
            expect_solid(mesh, {normal, offset}, fmt::format("{} {}", name, i));
        }
}

TEST(Section, PlanesThroughVerticesEdgesAndFacesAreExact) {
    const std::pair<const char*, Mesh> bodies[] = {{"cube", built(testing::cube())},
                                                   {"sphere", built(sphere(1, DVec3(0), 8))},
                                                   {"torus", built(torus(1, 0.4, 8))},
                                                   {"shells", built(nested_shells())}};
    for (const auto& [name, mesh] : bodies)
        for (const DVec3 normal : {DVec3(1, 0, 0), DVec3(0, 1, 0), DVec3(0, 0, -1), DVec3(1, 1, 0),
                                   DVec3(1, -1, 0), DVec3(1, 1, 1), DVec3(0, -2, 2)})
            for (std::size_t v = 0; v < mesh.position.size(); v += mesh.position.size() / 60 + 1) {
                const double offset = dot3(normal, DVec3(mesh.position[v])); // through the vertex
                expect_solid(
                    mesh, {normal, offset},
                    fmt::format("{} {} {} {} at {}", name, normal.x, normal.y, normal.z, offset));
            }
}

// A step: its floor lies in the plane and stays as it is, the wall on it is capped beside it.
TEST(Section, AFaceInThePlaneStaysWhereItBoundsTheBody) {
    PolygonMesh stairs;
    for (const double y : {-1.0, 1.0})
        for (const auto& [x, z] :
             {std::pair(-1.0, -1.0), {1.0, -1.0}, {1.0, 0.0}, {0.0, 0.0}, {0.0, 1.0}, {-1.0, 1.0}})
            stairs.positions.emplace_back(x, y, z);
    testing::add_face(stairs, {0, 1, 2, 3, 4, 5});
    testing::add_face(stairs, {11, 10, 9, 8, 7, 6});
    for (int i = 0; i < 6; ++i)
        testing::add_face(stairs, {(i + 1) % 6, i, 6 + i, 6 + (i + 1) % 6});
    const Mesh mesh = built(std::move(stairs));
    ASSERT_TRUE(topology(mesh).closed);
    ASSERT_GT(volume(mesh, DVec3(0)), 0);
    expect_solid(mesh, {{0, 0, 1}, 0}, "stairs");
    expect_solid(mesh, {{0, 0, -1}, 0}, "stairs from below");
    const auto found = cut_by_plane(jobs(), mesh, {{0, 0, 1}, 0}, kCap);
    std::size_t floor = 0;
    for (std::size_t t = 0; t < found->mesh.triangles(); ++t) {
        bool level = true;
        for (std::size_t k = 0; k < 3; ++k)
            level = level && found->mesh.position[found->mesh.index[3 * t + k]].z == 0;
        floor += level && found->mesh.material[t] != kCap ? 1 : 0;
    }
    EXPECT_EQ(floor, 2U);
    EXPECT_EQ(found->caps, 3U); // five points: the wall behind has a diagonal
}

TEST(Section, OpenSurfacesAreCappedWhereTheyCloseAndSayWhereTheyDoNot) {
    PolygonMesh box = testing::cube(0.5, DVec3(-2, 0, 0)),
                open = testing::cube(0.5, DVec3(2, 0, 0));
    PolygonMesh both = box;
    for (std::size_t f = 0; f + 1 < open.faces(); ++f) { // without its side at the greatest x
        std::vector<std::int32_t> corners;
        for (std::size_t c = open.face_begin[f]; c < open.face_end(f); ++c)
            corners.push_back(8 + open.corners[c].position);
        if (f == 0)
            both.positions.insert(both.positions.end(), open.positions.begin(),
                                  open.positions.end());
        testing::add_face(both, corners);
    }
    const Mesh mesh = built(std::move(both));
    const auto found = cut_by_plane(jobs(), mesh, {{0, 0, 1}, 0.01}, kCap);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->edges, 8U + 6U);
    EXPECT_EQ(found->open_edges, 6U);
    EXPECT_EQ(found->caps, 6U);
    const auto level = cut_by_plane(jobs(), mesh, {{1, 0, 0}, 0}, kCap); // both sides whole
    ASSERT_TRUE(level);
    EXPECT_EQ(level->edges, 0U);
}

// A box without a lid whose rim lies in the plane is open there, whatever rises beside it.
TEST(Section, ARimInThePlaneIsNotCapped) {
    PolygonMesh both = testing::cube(0.5, DVec3(-2, 0, 0));
    append(both, testing::cube(0.5, DVec3(2, 0, -0.5)), false,
           1); // without the side at the greatest z
    const Mesh mesh = built(std::move(both));
    const auto rim = static_cast<float>(std::ldexp(0 - mesh.centre.z, -mesh.exponent));
    const auto found = cut_by_plane(jobs(), mesh, {{0, 0, 1}, rim}, kCap);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->edges, 8U);
    EXPECT_EQ(found->open_edges, 0U);
    EXPECT_EQ(found->caps, 6U);
}

TEST(Section, FacesWoundAgainstTheirNeighboursAreCapped) {
    PolygonMesh mixed;
    const PolygonMesh whole = testing::cube();
    mixed.positions = whole.positions;
    for (std::size_t f = 0; f < whole.faces(); ++f) {
        std::vector<std::int32_t> corners;
        for (std::size_t c = whole.face_begin[f]; c < whole.face_end(f); ++c)
            corners.push_back(whole.corners[c].position);
        if (f % 2 == 0) std::reverse(corners.begin(), corners.end());
        testing::add_face(mixed, corners);
    }
    const auto found = cut_by_plane(jobs(), built(std::move(mixed)), {{0, 0, 1}, 0.1}, kCap);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->caps, 6U);
    EXPECT_EQ(found->open_edges, 0U);
}

TEST(Section, ABodyInsideOutStaysClosedAndInsideOut) {
    PolygonMesh turned;
    append(turned, nested_shells(), true);
    const Mesh mesh = built(std::move(turned));
    ASSERT_LT(volume(mesh, DVec3(0)), 0);
    expect_solid(mesh, {{1, 2, 3}, 0.1}, "inside out");
}

TEST(Section, NormalsUvAndColoursAreInterpolated) {
    Mesh mesh = built(sphere(1, DVec3(0)));
    for (const Vec3& p : mesh.position) {
        mesh.colour.push_back(p * 0.5F + 0.5F);
        mesh.uv.emplace_back(p.x, p.y);
    }
    const std::size_t whole = mesh.position.size();
    const auto found = cut_by_plane(jobs(), mesh, {{1, 2, -1}, 0.3}, kCap);
    ASSERT_TRUE(found);
    ASSERT_LT(found->mesh.position.size(), whole);
    std::size_t cut = 0;
    for (std::size_t t = 0; t < found->mesh.triangles(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = found->mesh.index[3 * t + k];
            const Vec3& p = found->mesh.position[v];
            const Vec3& n = found->mesh.normal[v];
            EXPECT_NEAR(dot3(n, n), 1, 1e-5);
            if (found->mesh.material[t] == kCap) {
                EXPECT_EQ(found->mesh.colour[v], Vec3(1));
                continue;
            }
            cut += std::abs(p.x + 2 * p.y - p.z - 0.3F) < 1e-5F ? 1 : 0;
            EXPECT_NEAR(found->mesh.colour[v].x, p.x * 0.5F + 0.5F, 1e-6);
            EXPECT_NEAR(found->mesh.uv[v].y, p.y, 1e-6);
            EXPECT_GT(dot3(n, p), 0.95F * std::sqrt(dot3(p, p)));
        }
    EXPECT_GT(cut, 50U);
}

TEST(Section, LinesAreCutAndPointsInFrontLeftOut) {
    PolygonMesh lines;
    lines.positions = {DVec3(0, 0, -1), DVec3(0, 0, 1), DVec3(1, 0, 1), DVec3(1, 0, -1)};
    lines.line_begin = {0};
    lines.line_vertices = {0, 1, 2, 3};
    lines.line_material = {-1};
    lines.point_vertices = {1, 3};
    lines.point_material = {-1, -1};
    const Mesh mesh = built(std::move(lines));
    const auto found = cut_by_plane(jobs(), mesh, {{0, 0, 1}, 0}, kCap);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->mesh.lines(), 2U);
    EXPECT_EQ(found->mesh.points(), 1U);
    for (const std::uint32_t v : found->mesh.line_index)
        EXPECT_LE(found->mesh.position[v].z, 0);
}

} // namespace
} // namespace scanout::geom
