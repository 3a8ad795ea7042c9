#include "geom/diagnose/meshes.h"
#include "geom/mend_seams.h"
#include "geom/open_edges.h"

#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::geom::testing {
namespace {

std::vector<OpenEdge> open_edges_of(const PolygonMesh& mesh,
                                    OpenEdgeSearch search = OpenEdgeSearch::complete) {
    const Usable usable(jobs(), mesh);
    return open_edges(jobs(), mesh, usable, framing_of(jobs(), mesh.positions, usable.position),
                      search);
}

// By comparing positions: an edge is open where all its uses are of faces with the same corners,
// and none is of a face that has it twice. Faces on one or two places do not count.
std::vector<OpenEdge> naive_open_edges(const PolygonMesh& mesh) {
    using Point = std::array<double, 3>;
    const auto at = [&](std::size_t corner) {
        const DVec3& p = mesh.positions[static_cast<std::size_t>(mesh.corners[corner].position)];
        return Point{p.x, p.y, p.z};
    };
    struct Uses {
        std::vector<std::uint32_t> faces;
        std::set<std::multiset<Point>> shapes;
    };
    std::map<std::set<Point>, Uses> uses;
    std::vector<std::pair<OpenEdge, std::set<Point>>> edges;
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
        std::multiset<Point> shape;
        for (std::size_t c = mesh.face_begin[f]; c < mesh.face_end(f); ++c)
            shape.insert(at(c));
        if (std::set<Point>(shape.begin(), shape.end()).size() < 3) continue;
        for (std::size_t c = mesh.face_begin[f]; c < mesh.face_end(f); ++c) {
            const std::size_t next = c + 1 < mesh.face_end(f) ? c + 1 : mesh.face_begin[f];
            const std::set<Point> ends{at(c), at(next)};
            if (ends.size() < 2) continue;
            uses[ends].faces.push_back(f);
            uses[ends].shapes.insert(shape);
            edges.push_back({{f, static_cast<std::uint32_t>(c)}, ends});
        }
    }
    std::vector<OpenEdge> open;
    for (const auto& [edge, ends] : edges) {
        const Uses& all = uses[ends];
        const std::set<std::uint32_t> different(all.faces.begin(), all.faces.end());
        if (all.shapes.size() == 1 && different.size() == all.faces.size()) open.push_back(edge);
    }
    return open;
}

// How many faces on three places or more have the edge.
int uses_of(const PolygonMesh& mesh, const OpenEdge& edge) {
    const auto ends = [&](std::uint32_t face, std::size_t corner) {
        const std::size_t next =
            corner + 1 < mesh.face_end(face) ? corner + 1 : mesh.face_begin[face];
        const auto at = [&](std::size_t c) {
            return mesh.positions[static_cast<std::size_t>(mesh.corners[c].position)];
        };
        return std::pair(at(corner), at(next));
    };
    const auto wanted = ends(edge.face, edge.corner);
    int uses = 0;
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
        int of_face = 0;
        std::set<std::array<double, 3>> places;
        for (std::size_t c = mesh.face_begin[f]; c < mesh.face_end(f); ++c) {
            const auto [a, b] = ends(f, c);
            places.insert({a.x, a.y, a.z});
            of_face += (a == wanted.first && b == wanted.second) ||
                               (a == wanted.second && b == wanted.first)
                           ? 1
                           : 0;
        }
        uses += places.size() > 2 ? of_face : 0;
    }
    return uses;
}

RC_GTEST_PROP(OpenEdges, AreThoseThatPositionsTell, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    PolygonMesh mesh;
    const auto below = [&](unsigned n) { return static_cast<std::int32_t>(random() % n); };
    for (int i = 0; i < 9; ++i) // some at one place
        mesh.positions.push_back({below(3), below(2), below(2)});
    mesh.positions.push_back({9, 9, 9}); // so that coordinates are not those of places
    const int faces = *rc::gen::inRange(1, 40);
    for (int f = 0; f < faces; ++f) {
        if (random() % 4 == 0)
            add_face(mesh, {below(9), below(9), below(9), below(9)});
        else
            add_face(mesh, {below(9), below(9), below(9)});
    }
    add_face(mesh, {9, below(9), below(9)});
    const std::vector<OpenEdge> expected = naive_open_edges(mesh);
    RC_ASSERT(open_edges_of(mesh) == expected);
    // The quick search: those of one use all, of the others perhaps.
    const std::vector<OpenEdge> odd = open_edges_of(mesh, OpenEdgeSearch::odd);
    std::size_t next = 0;
    for (const OpenEdge& edge : expected) {
        const bool found = next < odd.size() && odd[next] == edge;
        next += found ? 1 : 0;
        RC_ASSERT(found || uses_of(mesh, edge) % 2 == 0);
    }
    RC_ASSERT(next == odd.size());
}

PolygonMesh box() {
    PolygonMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back({i & 1, i >> 1 & 1, i >> 2});
    for (const std::array<std::int32_t, 4> f : {std::array{0, 2, 3, 1},
                                                {4, 5, 7, 6},
                                                {0, 1, 5, 4},
                                                {2, 6, 7, 3},
                                                {0, 4, 6, 2},
                                                {1, 3, 7, 5}})
        add_face(mesh, {f[0], f[1], f[2], f[3]});
    return mesh;
}

TEST(OpenEdges, ABoxHasNoneAndALidThatIsOffFour) {
    PolygonMesh mesh = box();
    EXPECT_TRUE(open_edges_of(mesh).empty());
    mesh.face_begin.pop_back();
    mesh.face_material.pop_back();
    mesh.face_smoothing.clear();
    mesh.corners.resize(20);
    EXPECT_EQ(open_edges_of(mesh).size(), 4U);
}

TEST(SplitTVertices, ClosesTheSeamOfThreeDecimalsAndMovesNoVertex) {
    for (const bool doubled : {false, true}) { // each face with its turned twin
        PolygonMesh mesh = t_junction_grid(3);
        if (doubled) {
            const PolygonMesh back = turned(mesh);
            const std::size_t corners = mesh.corners.size();
            mesh.corners.insert(mesh.corners.end(), back.corners.begin(), back.corners.end());
            for (const std::uint32_t begin : back.face_begin)
                mesh.face_begin.push_back(begin + static_cast<std::uint32_t>(corners));
            mesh.face_material.resize(mesh.faces(), -1);
            mesh.face_smoothing.clear();
        }
        const std::size_t sheets = doubled ? 2 : 1;
        EXPECT_EQ(diagnosed(mesh).count(Hazard::t_vertices), 6 * sheets);
        const std::vector<DVec3> before = mesh.positions;
        const SplitEdges split = split_t_vertices(jobs(), mesh, 1e-3);
        EXPECT_EQ(split.corners, 6 * sheets);
        EXPECT_GT(split.farthest, 1e-5);
        EXPECT_LT(split.farthest, 1e-3);
        EXPECT_EQ(mesh.positions, before);
        EXPECT_EQ(mesh.face_end(0), 10U);
        EXPECT_EQ(diagnosed(mesh).count(Hazard::t_vertices), 0U);
        EXPECT_EQ(open_edges_of(mesh).size(), 12 * sheets);
        EXPECT_EQ(split_t_vertices(jobs(), mesh, 1e-3).corners, 0U);
    }
}

// Decimation leaves faces such as `f 1 2 1`, which cover nothing.
TEST(OpenEdges, AFaceOnTwoPlacesHidesNone) {
    PolygonMesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {1, 2, 0}};
    add_face(mesh, {0, 1, 2});
    add_face(mesh, {0, 1, 0});
    add_face(mesh, {1, 2, 1, 2});
    for (const OpenEdgeSearch search : {OpenEdgeSearch::odd, OpenEdgeSearch::complete})
        EXPECT_EQ(open_edges_of(mesh, search), (std::vector<OpenEdge>{{0, 0}, {0, 1}, {0, 2}}));
}

TEST(SplitTVertices, ClosesASeamThatAFaceOnTwoPlacesLiesOn) {
    for (const TVertices which : {TVertices::seams, TVertices::all}) {
        PolygonMesh mesh = t_junction_grid(3);
        PolygonMesh same = mesh;
        const Corner a = mesh.corners[0], b = mesh.corners[1], c = mesh.corners[2];
        for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
            add_face(mesh, {from.position, to.position, from.position});
        EXPECT_EQ(split_t_vertices(jobs(), same, 1e-3, which).corners, 6U);
        EXPECT_EQ(split_t_vertices(jobs(), mesh, 1e-3, which).corners, 6U);
    }
}

// Needles round one edge, each near all others: every vertex lies near every edge, so the number of
// T-vertices grows with the square of that of the faces. None is looked for, and none is claimed.
TEST(SplitTVertices, AmongNeedlesThatLieCloseTogetherIsGivenUpInTime) {
    for (const int needles : {20, 20'000}) {
        PolygonMesh mesh;
        mesh.positions = {{0, 0, 0}, {0, 1, 0}};
        for (int i = 0; i < needles; ++i) {
            mesh.positions.push_back({1.0 + i % 97, 0, static_cast<double>(i)});
            add_face(mesh, {0, 1, i + 2});
        }
        const std::vector<Corner>::size_type corners = mesh.corners.size();
        const bool many = needles > 1000;
        DiagnoseOptions how;
        how.seconds = 0; // of the search for pairs
        const Diagnosis found = diagnose(jobs(), mesh, how);
        for (const Hazard hazard : {Hazard::t_vertices, Hazard::cracks}) {
            ASSERT_EQ(found.find(hazard) != nullptr, many);
            EXPECT_TRUE(!many || found.find(hazard)->searched == 0);
        }
        const SplitEdges split = split_t_vertices(jobs(), mesh, 1e-3, TVertices::seams);
        EXPECT_EQ(split.crowded, many);
        EXPECT_EQ(split.unsearched, many ? 2U * static_cast<std::size_t>(needles) : 0U);
        EXPECT_EQ(mesh.corners.size(), corners);
    }
}

// A triangle whose corner touches another one's edge is no seam; one whose edge lies along it is.
TEST(SplitTVertices, OfSeamsLeavesVerticesThatOnlyTouchAnEdge) {
    for (const bool along : {false, true}) {
        PolygonMesh mesh;
        mesh.positions = {{0, 0, 0},       {2, 0, 0},  {1, 2, 0},
                          {0.9, -1e-4, 0}, {1, -1, 0}, {along ? 2.0 : 1.5, along ? 0 : -1, 0}};
        add_face(mesh, {0, 1, 2});
        add_face(mesh, {3, 4, along ? 1 : 5});
        PolygonMesh all = mesh;
        EXPECT_EQ(split_t_vertices(jobs(), all, 1e-3, TVertices::all).corners, 1U);
        EXPECT_EQ(split_t_vertices(jobs(), mesh, 1e-3, TVertices::seams).corners, along ? 1U : 0U);
    }
}

// Neither side's vertices are the other's: 0 2 4 6 against 0 3 6.
TEST(SplitTVertices, ClosesASeamOfTwoSubdivisions) {
    PolygonMesh mesh;
    for (const int x : {0, 2, 4, 6})
        mesh.positions.insert(mesh.positions.end(), {DVec3(x, 0, 0), DVec3(x, 1, 0)});
    for (const int x : {0, 3, 6})
        mesh.positions.insert(mesh.positions.end(), {DVec3(x, 0, 0), DVec3(x, -1, 0)});
    for (const std::int32_t i : {0, 2, 4})
        add_face(mesh, {i, i + 2, i + 3, i + 1});
    for (const std::int32_t i : {8, 10})
        add_face(mesh, {i, i + 1, i + 3, i + 2});
    EXPECT_EQ(split_t_vertices(jobs(), mesh, 1e-3, TVertices::seams).corners, 3U);
    EXPECT_EQ(open_edges_of(mesh).size(), 3U + 2U + 4U);
}

TEST(SplitTVertices, LeavesVerticesFartherThanTheTolerance) {
    PolygonMesh mesh = t_junction_grid(1);
    const std::vector<std::uint32_t> begins = mesh.face_begin;
    EXPECT_EQ(split_t_vertices(jobs(), mesh, 1e-5).corners, 0U);
    EXPECT_EQ(mesh.face_begin, begins);
}

} // namespace
} // namespace scanout::geom::testing
