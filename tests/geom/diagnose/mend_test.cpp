#include "geom/diagnose/meshes.h"
#include "geom/mend.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace scanout::geom::testing {
namespace {

constexpr double kTolerance = 1e-3;

TEST(Mend, LeavesAGoodMeshAlone) {
    PolygonMesh mesh = cube();
    EXPECT_FALSE(mend(jobs(), mesh, kTolerance).any());
    EXPECT_EQ(mesh.positions, cube().positions);
    EXPECT_EQ(mesh.faces(), 6U);
}

TEST(Mend, TellsHowFarItIs) {
    PolygonMesh mesh = cube();
    std::vector<double> shares;
    mend(jobs(), mesh, kTolerance, [&](double share) { shares.push_back(share); });
    EXPECT_GE(shares.size(), 3U);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    ASSERT_FALSE(shares.empty());
    EXPECT_DOUBLE_EQ(shares.back(), 1);
}

TEST(Mend, SplitsEdgesAtTVerticesAndMovesNone) {
    PolygonMesh mesh = t_junction_grid(3);
    mesh.uvs = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
    mesh.normals = {{0, 0, 1}, {0, 1, 0}};
    for (std::size_t i = 0; i < 4; ++i) { // of the coarse quad; its second edge is the seam
        mesh.corners[i].uv = std::array{0, 2, 3, 1}[i];
        mesh.corners[i].normal = i < 2 ? 0 : 1;
    }
    const std::vector<DVec3> before = mesh.positions;
    const Mended report = mend(jobs(), mesh, kTolerance);
    EXPECT_EQ(report.split, 6U);
    EXPECT_EQ(mesh.positions, before);
    EXPECT_EQ(diagnosed(mesh).count(Hazard::t_vertices), 0U);
    EXPECT_EQ(diagnosed(mesh).count(Hazard::open_edges), 3U + 7U + 2U)
        << "the seam's edges are shared";
    ASSERT_EQ(mesh.face_end(0), 10U);
    for (std::size_t c = 2; c < 8; ++c) {
        const double along = static_cast<double>(c - 1) / 7;
        const DVec2 uv = mesh.uvs[static_cast<std::size_t>(mesh.corners[c].uv)];
        EXPECT_NEAR(uv.x, 1, 1e-12);
        EXPECT_NEAR(uv.y, along, 2e-3);
        const Vec3 n = mesh.normals[static_cast<std::size_t>(mesh.corners[c].normal)];
        EXPECT_NEAR(n.y / (n.y + n.z), along, 2e-3);
        EXPECT_NEAR(dot3(n, n), 1, 1e-6);
    }
}

TEST(Mend, WeldsAndRemoves) {
    PolygonMesh mesh = cube();
    mesh.positions.push_back(mesh.positions[0]); // 8
    mesh.positions.push_back({7, 7, 7});         // 9: unused
    mesh.positions.push_back({7, 7, 8});         // 10: of a face that goes
    mesh.corners[0].position = 8;
    add_face(mesh, {2, 3, 1, 0}); // repeats the first
    add_face(mesh, {10, 10, 10}); // no area
    add_face(mesh, {0, 1, 0}, 5); // no area
    const Mended report = mend(jobs(), mesh, kTolerance);
    EXPECT_EQ(report.welded, 1U);
    EXPECT_EQ(report.unused, 2U);
    EXPECT_EQ(report.repeated, 1U);
    EXPECT_EQ(report.degenerate, 2U);
    EXPECT_EQ(mesh.faces(), 6U);
    EXPECT_EQ(mesh.face_material.size(), 6U);
    EXPECT_EQ(mesh.face_smoothing.size(), 6U);
    EXPECT_EQ(mesh.positions.size(), 8U);
    EXPECT_TRUE(diagnosed(mesh).findings.empty());
}

TEST(Mend, TakesCornersOutThatStandTwice) {
    PolygonMesh mesh = cube();
    mesh.corners.insert(mesh.corners.begin() + 4, mesh.corners[3]); // 0 2 3 1 1
    mesh.corners.insert(mesh.corners.begin(), mesh.corners[0]);     // 0 0 2 3 1 1
    for (std::size_t f = 1; f < 6; ++f)
        mesh.face_begin[f] += 2;
    mend(jobs(), mesh, kTolerance);
    EXPECT_EQ(mesh.corners.size(), 24U);
    EXPECT_TRUE(diagnosed(mesh).findings.empty());
}

TEST(Mend, KeepsTheColoursOfPositionsThatDifferInThem) {
    PolygonMesh mesh = cube();
    mesh.positions.push_back(mesh.positions[0]);
    mesh.positions.push_back(mesh.positions[1]);
    mesh.colours.assign(10, Vec3(1));
    mesh.colours[8] = Vec3(0, 1, 0);
    mesh.corners[0].position = 8;
    mesh.corners[3].position = 9;
    const Mended report = mend(jobs(), mesh, kTolerance);
    EXPECT_EQ(report.welded, 1U);
    ASSERT_EQ(mesh.colours.size(), 9U);
    EXPECT_EQ(mesh.colours[8], Vec3(0, 1, 0));
    EXPECT_EQ(mesh.corners[0].position, 8);
    EXPECT_EQ(mesh.corners[3].position, 1);
}

TEST(Mend, TurnsFacesThatAreWoundAgainstMostOthers) {
    PolygonMesh mesh = cube();
    const std::vector<Corner> before = mesh.corners;
    std::reverse(mesh.corners.begin() + 8, mesh.corners.begin() + 12);
    EXPECT_EQ(mend(jobs(), mesh, kTolerance).turned, 1U);
    EXPECT_TRUE(diagnosed(mesh).findings.empty());
    mesh = turned(cube());
    EXPECT_EQ(mend(jobs(), mesh, kTolerance).turned, 6U) << "a closed shell: outwards";
    EXPECT_TRUE(diagnosed(mesh).findings.empty());
    mesh = cube();
    append(mesh, turned(cube(0.5)));
    EXPECT_FALSE(mend(jobs(), mesh, kTolerance).any()) << "a cavity stays";
}

TEST(Mend, LeavesAMoebiusStripAndSaysSo) {
    PolygonMesh mesh = moebius_strip(12);
    const Mended report = mend(jobs(), mesh, kTolerance);
    EXPECT_FALSE(report.any());
    EXPECT_EQ(report.one_sided, 1U);
}

TEST(Mend, KeepsLinesAndPoints) {
    PolygonMesh mesh;
    mesh.positions = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0},
                      {1, 0, 0}, {2, 0, 0}, DVec3(std::numeric_limits<double>::infinity())};
    mesh.line_begin = {0, 2, 4};
    mesh.line_vertices = {1, 5, 1, 2, 3, 4};
    mesh.line_material = {0, 1, 2};
    mesh.point_vertices = {5, 4};
    mesh.point_material = {3, 4};
    mend(jobs(), mesh, kTolerance);
    EXPECT_EQ(mesh.positions, (std::vector<DVec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
    EXPECT_EQ(mesh.line_begin, (std::vector<std::uint32_t>{0, 2}));
    EXPECT_EQ(mesh.line_vertices, (std::vector<std::uint32_t>{0, 1, 1, 2}));
    EXPECT_EQ(mesh.line_material, (std::vector<std::int32_t>{1, 2}));
    EXPECT_EQ(mesh.point_vertices, std::vector<std::uint32_t>{2});
    EXPECT_EQ(mesh.point_material, std::vector<std::int32_t>{4});
}

// Whatever the mesh: what --fix promises is gone, and mending again finds nothing to do.
TEST(Mend, EndsWithWhatItPromises) {
    for (std::uint32_t seed = 0; seed < 60; ++seed) {
        PolygonMesh mesh = soup(seed, 12, 40, true);
        for (DVec3& p : mesh.positions) // on a coarse grid: many places meet
            p = DVec3(std::round(p.x * 2), std::round(p.y * 2), std::round(p.z * 2));
        const Mended first = mend(jobs(), mesh, kTolerance);
        EXPECT_TRUE(first.any());
        const Diagnosis after = diagnosed(mesh);
        for (const Hazard hazard : {Hazard::t_vertices, Hazard::duplicate_faces, Hazard::zero_areas,
                                    Hazard::unreferenced, Hazard::flipped_shells})
            EXPECT_EQ(after.count(hazard), 0U) << seed << " " << card_of(hazard).name;
        if (first.one_sided == 0) {
            EXPECT_EQ(after.count(Hazard::mixed_winding), 0U) << seed;
        }
    }
}

} // namespace
} // namespace scanout::geom::testing
