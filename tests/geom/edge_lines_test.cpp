#include "geom/build.h"
#include "geom/edge_lines.h"
#include "geom/meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include <gtest/gtest.h>

namespace scanout::geom {
namespace {

using testing::add_face;

Mesh built(PolygonMesh polygons) {
    Warnings warnings;
    return build_mesh(std::move(polygons), {}, "test", warnings).mesh;
}

Mesh lines_of(const Mesh& mesh, std::optional<double> degrees = {}) {
    Mesh lines;
    std::optional<double> cosine;
    if (degrees) cosine = std::cos(*degrees * std::numbers::pi / 180);
    add_edge_lines(mesh, cosine, lines);
    return lines;
}

using Place = std::tuple<float, float, float>;
using Edge = std::pair<Place, Place>; // the lower first
Place place(const Vec3& p) {
    return {p.x, p.y, p.z};
}
Edge edge(const Vec3& a, const Vec3& b) {
    return {std::min(place(a), place(b)), std::max(place(a), place(b))};
}

// The faces of every line, by their numbers in the file.
std::map<Edge, std::vector<std::uint32_t>> edges_of(const Mesh& mesh, const Mesh& lines) {
    std::map<Edge, std::vector<std::uint32_t>> out;
    for (std::size_t line = 0; line < lines.lines(); ++line) {
        std::vector<std::uint32_t> faces;
        for (const std::uint32_t t : lines.line_faces.of(line)) {
            EXPECT_TRUE(t == 0 || mesh.face[t - 1] != mesh.face[t]) << "not the first of its face";
            faces.push_back(mesh.face[t]);
        }
        const Edge key = edge(lines.position[lines.line_index[line * 2]],
                              lines.position[lines.line_index[line * 2 + 1]]);
        EXPECT_TRUE(out.emplace(key, faces).second) << "twice";
    }
    return out;
}

TEST(EdgeLines, OfACubeOfSquaresAreItsTwelveEdgesEachWithTwoFaces) {
    const Mesh mesh = built(testing::cube());
    const auto edges = edges_of(mesh, lines_of(mesh));
    EXPECT_EQ(edges.size(), 12U) << "no diagonal, though the mesh has triangles";
    for (const auto& [ends, faces] : edges)
        EXPECT_EQ(faces.size(), 2U);
    EXPECT_EQ(lines_of(mesh, 89).lines(), 12U);
    EXPECT_EQ(lines_of(mesh, 91).lines(), 0U);
}

// By search: of every pair of places, the faces of which an odd number of triangles have it.
TEST(EdgeLines, OfAnythingAreTheBordersOfItsFacesEachOnce) {
    std::size_t found = 0;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        const Mesh mesh =
            built(testing::soup(seed, 12 + static_cast<int>(seed) * 3, 60, seed % 2 == 0));
        std::map<Edge, std::map<std::uint32_t, int>> triangles;
        for (std::size_t i = 0; i < mesh.index.size(); ++i) {
            const Vec3 &a = mesh.position[mesh.index[i]],
                       &b = mesh.position[mesh.index[i % 3 == 2 ? i - 2 : i + 1]];
            if (!(a == b)) ++triangles[edge(a, b)][mesh.face[i / 3]];
        }
        std::map<Edge, std::vector<std::uint32_t>> expected;
        for (const auto& [ends, faces] : triangles)
            for (const auto& [face, count] : faces)
                if (count % 2 == 1) expected[ends].push_back(face);
        ASSERT_EQ(edges_of(mesh, lines_of(mesh)), expected) << seed;
        found += expected.size();
    }
    EXPECT_GT(found, 1000U);
}

// A roof of two squares with this angle between their normals, one of them perhaps turned over.
Mesh roof(double degrees, bool turned) {
    const double angle = degrees * std::numbers::pi / 180;
    PolygonMesh mesh;
    mesh.positions = {{-1, 0, 0}, {-1, 0, 1}, {0, 0, 1}, {0, 0, 0}};
    mesh.positions.emplace_back(std::cos(angle), -std::sin(angle), 1);
    mesh.positions.emplace_back(std::cos(angle), -std::sin(angle), 0);
    add_face(mesh, {0, 1, 2, 3});
    add_face(mesh, turned ? std::vector<std::int32_t>{5, 4, 2, 3}
                          : std::vector<std::int32_t>{3, 2, 4, 5});
    return built(std::move(mesh));
}

TEST(EdgeLines, OfFeaturesAreEndsOfTheSurfaceAndBendsOfMoreThanTheAngle) {
    for (const bool turned : {false, true})
        for (const double bend : {0.0, 10.0, 29.0, 31.0, 90.0, 150.0}) {
            const Mesh mesh = roof(bend, turned);
            ASSERT_EQ(lines_of(mesh).lines(), 7U);
            EXPECT_EQ(lines_of(mesh, 30).lines(), bend > 30 ? 7U : 6U) << bend << ' ' << turned;
        }
}

TEST(EdgeLines, WhereThreeFacesMeetAreFeatures) {
    PolygonMesh three;
    three.positions = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {-1, 0, 1e-3}};
    for (const std::int32_t third : {2, 3, 4})
        add_face(three, {0, 1, third});
    const Mesh mesh = built(std::move(three));
    EXPECT_EQ(lines_of(mesh).lines(), 7U);
    EXPECT_EQ(lines_of(mesh, 180).lines(), 7U);
}

// The lines' own come first, and lie on no face.
TEST(EdgeLines, ComeAfterLinesThatAreThere) {
    const Mesh mesh = built(testing::cube());
    Mesh lines;
    lines.position = {Vec3(0), Vec3(1)};
    lines.line_index = {0, 1};
    add_edge_lines(mesh, {}, lines);
    ASSERT_EQ(lines.lines(), 13U);
    EXPECT_TRUE(lines.line_faces.of(0).empty());
    for (std::size_t line = 1; line < 13; ++line)
        EXPECT_EQ(lines.line_faces.of(line).size(), 2U);
}

} // namespace
} // namespace scanout::geom
