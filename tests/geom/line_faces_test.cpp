#include "geom/build.h"
#include "geom/line_faces.h"
#include "geom/meshes.h"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

namespace scanout::geom {
namespace {

using testing::add_face;

void add_line(PolygonMesh& mesh, std::uint32_t a, std::uint32_t b) {
    mesh.line_begin.push_back(static_cast<std::uint32_t>(mesh.line_vertices.size()));
    mesh.line_vertices.insert(mesh.line_vertices.end(), {a, b});
    mesh.line_material.push_back(-1);
}

std::vector<std::uint32_t> faces_of(const Mesh& mesh, std::size_t line) {
    std::vector<std::uint32_t> out;
    for (const std::uint32_t t : mesh.line_faces.of(line)) {
        EXPECT_TRUE(t == 0 || mesh.face[t - 1] != mesh.face[t]) << "not the first of its face";
        out.push_back(mesh.face[t]);
    }
    return out;
}

// Of every line: the faces whose corners stand where both of its ends stand.
void expect_faces_by_search(const Mesh& mesh) {
    for (std::size_t line = 0; line < mesh.lines(); ++line) {
        std::set<std::uint32_t> with_first, with_second;
        for (std::size_t i = 0; i < mesh.index.size(); ++i) {
            const Vec3& at = mesh.position[mesh.index[i]];
            if (at == mesh.position[mesh.line_index[line * 2]]) with_first.insert(mesh.face[i / 3]);
            if (at == mesh.position[mesh.line_index[line * 2 + 1]])
                with_second.insert(mesh.face[i / 3]);
        }
        std::vector<std::uint32_t> both;
        std::set_intersection(with_first.begin(), with_first.end(), with_second.begin(),
                              with_second.end(), std::back_inserter(both));
        ASSERT_EQ(faces_of(mesh, line), both) << line;
    }
}

TEST(LineFaces, AreThoseWithBothEndsAmongTheirCorners) {
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        PolygonMesh soup = testing::soup(seed, 12 + static_cast<int>(seed) * 3, 60, true);
        std::mt19937 random(seed);
        const auto vertex = [&] {
            return static_cast<std::uint32_t>(random() % soup.positions.size());
        };
        for (int i = 0; i < 300; ++i)
            add_line(soup, vertex(), vertex()); // some of no length, some twice
        Warnings warnings;
        const BuildResult built = build_mesh(std::move(soup), {}, "soup", warnings);
        ASSERT_EQ(built.mesh.lines(), 300U);
        expect_faces_by_search(built.mesh);
    }
}

TEST(LineFaces, OfACubeAreTwoAnEdgeAndOneADiagonal) {
    PolygonMesh cube = testing::cube();
    add_line(cube, 0, 1); // an edge
    add_line(cube, 1, 0);
    add_line(cube, 0, 3); // across a face, and not
    add_line(cube, 1, 2);
    add_line(cube, 0, 7); // across the cube
    Warnings warnings;
    const Mesh mesh = build_mesh(std::move(cube), {}, "cube", warnings).mesh;
    EXPECT_EQ(faces_of(mesh, 0).size(), 2U);
    EXPECT_EQ(faces_of(mesh, 1), faces_of(mesh, 0));
    EXPECT_EQ(faces_of(mesh, 2), std::vector<std::uint32_t>{0});
    EXPECT_EQ(faces_of(mesh, 3), std::vector<std::uint32_t>{0});
    EXPECT_TRUE(faces_of(mesh, 4).empty());
}

TEST(LineFaces, CostNothingWhereNoLineLiesOnAFace) {
    PolygonMesh cube = testing::cube();
    Warnings warnings;
    PolygonMesh with_line = cube;
    add_line(with_line, 0, 7);
    for (PolygonMesh* polygons : {&cube, &with_line}) {
        const Mesh mesh = build_mesh(std::move(*polygons), {}, "cube", warnings).mesh;
        EXPECT_TRUE(mesh.line_faces.list.empty() && mesh.line_faces.triangle.empty());
        for (std::size_t line = 0; line < mesh.lines(); ++line)
            EXPECT_TRUE(mesh.line_faces.of(line).empty());
    }
}

// A fan and its rim as one large polygon, every spoke and rim edge a line: seconds, were it
// quadratic.
TEST(LineFaces, OfAHubWithManySpokesAreFoundInTimeThatGrowsWithTheFile) {
    constexpr std::uint32_t kSpokes = 200000;
    Mesh mesh;
    mesh.position.emplace_back(0);
    for (std::uint32_t i = 1; i <= kSpokes; ++i)
        mesh.position.emplace_back(i, i % 1000, i % 77);
    for (std::uint32_t a = 1; a < kSpokes; ++a) {
        const std::uint32_t b = a + 1;
        mesh.index.insert(mesh.index.end(), {0, a, b});
        mesh.face.push_back(a);
        mesh.line_index.insert(mesh.line_index.end(), {0, a, a, b});
    }
    for (std::uint32_t i = 2; i < kSpokes; ++i) { // all of one face
        mesh.index.insert(mesh.index.end(), {1, i, i + 1});
        mesh.face.push_back(kSpokes);
    }
    find_line_faces(mesh);
    EXPECT_EQ(mesh.line_faces.of(2).size(), 2U); // a spoke
    EXPECT_EQ(mesh.line_faces.of(3).size(), 2U); // on the rim: of its triangle and the polygon
    EXPECT_EQ(mesh.line_faces.triangle.size(), 4U * (kSpokes - 1) - 1);
}

} // namespace
} // namespace scanout::geom
