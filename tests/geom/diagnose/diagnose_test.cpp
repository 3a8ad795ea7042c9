// Meshes whose hazards are known, each built by hand.
#include "geom/diagnose/diagnose.h"
#include "geom/diagnose/meshes.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace scanout::geom::testing {
namespace {

std::vector<Hazard> hazards_of(const Diagnosis& diagnosis) {
    std::vector<Hazard> hazards;
    for (const Finding& finding : diagnosis.findings)
        hazards.push_back(finding.hazard);
    return hazards;
}
using Hazards = std::vector<Hazard>;

const Finding& finding(const Diagnosis& diagnosis, Hazard hazard) {
    static const Finding none;
    const Finding* found = diagnosis.find(hazard);
    return found != nullptr ? *found : none;
}

TEST(Diagnose, FindsNothingInACube) {
    EXPECT_EQ(hazards_of(diagnosed(cube())), Hazards());
    EXPECT_EQ(hazards_of(diagnosed(cube(1e5, DVec3(3, 2, 1)))), Hazards());
}

TEST(Diagnose, CountsTheOpenEdgesOfACubeWithoutALid) {
    PolygonMesh mesh = cube();
    mesh.face_begin.pop_back();
    mesh.face_material.pop_back();
    mesh.face_smoothing.pop_back();
    mesh.corners.resize(20);
    const Diagnosis found = diagnosed(mesh);
    EXPECT_EQ(hazards_of(found), Hazards{Hazard::open_edges});
    EXPECT_EQ(found.count(Hazard::open_edges), 4U);
}

TEST(Diagnose, CountsTheEdgesOfAFaceThatIsTurnedAround) {
    PolygonMesh mesh = cube();
    std::swap(mesh.corners[9], mesh.corners[11]); // the third face
    const Diagnosis found = diagnosed(mesh);
    EXPECT_EQ(hazards_of(found), Hazards{Hazard::mixed_winding});
    EXPECT_EQ(found.count(Hazard::mixed_winding), 4U);
    EXPECT_NE(found.marks[2] & mask_of(Hazard::mixed_winding), 0U);
}

TEST(Diagnose, NoWindingSuitsAMoebiusStrip) {
    const Diagnosis found = diagnosed(moebius_strip(24));
    EXPECT_EQ(found.count(Hazard::mixed_winding), 1U);
    EXPECT_EQ(found.count(Hazard::open_edges), 48U);
    EXPECT_EQ(found.count(Hazard::flipped_shells), 0U);
}

TEST(Diagnose, AShellInsideOutIsNoCavity) {
    PolygonMesh mesh = cube();
    append(mesh, turned(cube(0.5)));
    EXPECT_EQ(hazards_of(diagnosed(mesh)), Hazards()) << "a cavity";
    append(mesh, turned(cube(0.5, DVec3(5, 0, 0))));
    const Diagnosis found = diagnosed(mesh);
    EXPECT_EQ(hazards_of(found), Hazards{Hazard::flipped_shells});
    EXPECT_EQ(finding(found, Hazard::flipped_shells).worst.face, 12U);
    EXPECT_EQ(finding(found, Hazard::flipped_shells).measure, 12) << "triangles";
}

TEST(Diagnose, TellsRepeatedFacesFromTurnedOnes) {
    PolygonMesh mesh = cube();
    add_face(mesh, {3, 1, 0, 2}); // the first one from another corner on
    const Diagnosis repeated = diagnosed(mesh);
    EXPECT_EQ(repeated.count(Hazard::duplicate_faces), 1U);
    EXPECT_EQ(finding(repeated, Hazard::duplicate_faces).worst.face, 6U);
    EXPECT_EQ(finding(repeated, Hazard::duplicate_faces).worst.other_face, 0U);
    EXPECT_EQ(repeated.count(Hazard::back_to_back), 0U);
    EXPECT_EQ(repeated.count(Hazard::non_manifold_edges), 0U) << "the edges of both are one";
    mesh = cube();
    add_face(mesh, {2, 0, 1, 3});
    const Diagnosis back = diagnosed(mesh);
    EXPECT_EQ(back.count(Hazard::duplicate_faces), 0U);
    EXPECT_EQ(back.count(Hazard::back_to_back), 1U);
}

TEST(Diagnose, FindsTheVerticesOfAFineGridWithinTheEdgesOfACoarseOne) {
    const PolygonMesh mesh = t_junction_grid(3);
    const Diagnosis found = diagnosed(mesh);
    EXPECT_EQ(found.count(Hazard::t_vertices), 6U);
    const Finding& t = finding(found, Hazard::t_vertices);
    EXPECT_GT(t.measure, 1e-5);
    EXPECT_LT(t.measure, 1e-3) << "half of the third decimal in x, y and z";
    EXPECT_EQ(found.count(Hazard::cracks), 0U);
}

TEST(Diagnose, FindsCracksBetweenVerticesThatShouldBeOne) {
    PolygonMesh mesh;
    mesh.positions = {{0, 0, 0},      {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                      {1, 0, 0.0004}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}};
    add_face(mesh, {0, 1, 2, 3});
    add_face(mesh, {4, 5, 6, 7}); // (1, 1, 0) stands there twice: one place
    const Diagnosis found = diagnosed(mesh);
    EXPECT_EQ(found.count(Hazard::cracks), 1U);
    EXPECT_NEAR(finding(found, Hazard::cracks).measure, 0.0004, 1e-12);
    EXPECT_EQ(found.count(Hazard::t_vertices), 0U);
}

TEST(Diagnose, MeasuresSliversAndFacesWithoutAnArea) {
    PolygonMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 0.0005, 0}, {0.5, 0, 0}, {0.5, 0.001, 0}};
    add_face(mesh, {0, 1, 2}); // 2000
    add_face(mesh, {0, 3, 1}); // on a line
    add_face(mesh, {0, 2, 2}); // between two places
    add_face(mesh, {0, 1, 4}); // 1000: the limit
    const Diagnosis found = diagnosed(mesh);
    EXPECT_EQ(found.count(Hazard::zero_areas), 2U);
    EXPECT_EQ(found.count(Hazard::slivers), 2U);
    EXPECT_NEAR(finding(found, Hazard::slivers).measure, 2000, 1e-6);
    EXPECT_EQ(finding(found, Hazard::slivers).worst.face, 0U);
}

TEST(Diagnose, JudgesNormalsByTheirFaces) {
    PolygonMesh mesh = cube();
    mesh.normals = {{0, 0, -1},
                    {0, 0, 1},
                    {0, 0, 0},
                    {0, 0, -3},
                    {std::numeric_limits<float>::quiet_NaN(), 0, 1}};
    for (int corner = 0; corner < 4; ++corner)
        mesh.corners[static_cast<std::size_t>(corner)].normal = std::array{0, 1, 2, 3}[corner];
    mesh.corners[4].normal = 4;
    const Diagnosis found = diagnosed(mesh);
    EXPECT_EQ(hazards_of(found), (Hazards{Hazard::opposite_normals, Hazard::zero_normals,
                                          Hazard::long_normals, Hazard::missing_normals}));
    EXPECT_EQ(found.count(Hazard::opposite_normals), 1U);
    EXPECT_NEAR(finding(found, Hazard::opposite_normals).measure, 180, 1e-9);
    EXPECT_EQ(found.count(Hazard::zero_normals), 2U);
    EXPECT_EQ(finding(found, Hazard::long_normals).measure, 3);
    EXPECT_EQ(found.count(Hazard::missing_normals), 19U);
}

TEST(Diagnose, AsksForTextureCoordinatesOfTexturedFacesAlone) {
    PolygonMesh mesh = cube();
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {200, 0}};
    const auto give = [&](std::size_t face, std::array<int, 4> uvs) {
        for (std::size_t i = 0; i < 4; ++i)
            mesh.corners[4 * face + i].uv = uvs[i];
    };
    mesh.face_material = {0, 0, 0, 1, -1, 0};
    give(0, {0, 1, 2, 3});
    give(1, {0, 1, 0, 1}); // a line
    give(5, {0, 4, 2, 3});
    DiagnoseOptions how;
    how.textured = {true, false};
    const Diagnosis found = diagnose(jobs(), mesh, how);
    EXPECT_EQ(hazards_of(found),
              (Hazards{Hazard::missing_uvs, Hazard::degenerate_uvs, Hazard::large_uvs}));
    EXPECT_EQ(finding(found, Hazard::missing_uvs).worst.face, 2U);
    EXPECT_EQ(found.count(Hazard::missing_uvs), 1U);
    EXPECT_EQ(finding(found, Hazard::degenerate_uvs).worst.face, 1U);
    EXPECT_EQ(finding(found, Hazard::large_uvs).measure, 200);
}

TEST(Diagnose, JudgesNumbers) {
    PolygonMesh mesh = cube(1, DVec3(0, 0, 1e7));
    mesh.positions.push_back(DVec3(std::numeric_limits<double>::quiet_NaN()));
    mesh.positions.push_back(DVec3(9, 9, 9));
    const Diagnosis far = diagnosed(mesh);
    EXPECT_EQ(hazards_of(far),
              (Hazards{Hazard::not_finite, Hazard::unreferenced, Hazard::far_from_origin}));
    EXPECT_EQ(finding(far, Hazard::far_from_origin).measure, 1); // of floats from 2^23 to 2^24
    EXPECT_EQ(finding(far, Hazard::unreferenced).worst.position, 9U);

    mesh = cube();
    mesh.positions[0].x = -1e-41;
    EXPECT_EQ(diagnosed(mesh).count(Hazard::denormals), 1U);
    EXPECT_EQ(hazards_of(diagnosed(cube(1e8))), Hazards{Hazard::unusual_unit});
    EXPECT_EQ(hazards_of(diagnosed(cube(1e-6))), Hazards{Hazard::unusual_unit});

    mesh = cube();
    append(mesh, cube(1e-9, DVec3(0.3, 0.2, 0.1)));
    EXPECT_EQ(hazards_of(diagnosed(mesh)), Hazards{Hazard::collapsed_faces});
    EXPECT_EQ(diagnosed(mesh).count(Hazard::collapsed_faces), 6U);
}

TEST(Diagnose, FindsSurfacesInOnePlaneAndHowFarTheyAreApart) {
    PolygonMesh mesh = cube();
    append(mesh, cube(0.5, DVec3(0, 0, 1.5))); // stands on the first
    const Diagnosis touching = diagnosed(mesh);
    EXPECT_EQ(hazards_of(touching), Hazards{Hazard::overlaps});
    EXPECT_EQ(finding(touching, Hazard::overlaps).measure, 0);
    EXPECT_EQ(finding(touching, Hazard::overlaps).worst.face, 1U);
    EXPECT_EQ(finding(touching, Hazard::overlaps).worst.other_face, 6U);
    DiagnoseOptions how;
    how.gap = 1e-3;
    mesh = cube();
    append(mesh, cube(0.5, DVec3(0, 0, 1.5005)));
    EXPECT_EQ(hazards_of(diagnosed(mesh)), Hazards());
    const Diagnosis near = diagnose(jobs(), mesh, how);
    ASSERT_EQ(hazards_of(near), Hazards{Hazard::overlaps});
    EXPECT_NEAR(finding(near, Hazard::overlaps).measure, 0.0005, 1e-12);
}

TEST(Diagnose, CountsCubesThatReachIntoEachOther) {
    PolygonMesh mesh = cube();
    append(mesh, cube(1, DVec3(0.7, 0.6, 0.5)));
    const Diagnosis found = diagnosed(mesh);
    EXPECT_EQ(hazards_of(found), Hazards{Hazard::intersections});
    EXPECT_GE(found.count(Hazard::intersections), 6U);
    DiagnoseOptions how;
    how.search = false;
    EXPECT_EQ(hazards_of(diagnose(jobs(), mesh, how)), Hazards()) << "nothing is searched";
    how = {};
    how.seconds = -1;
    const Diagnosis cut = diagnose(jobs(), mesh, how);
    EXPECT_EQ(cut.count(Hazard::intersections), 0U);
    EXPECT_EQ(finding(cut, Hazard::intersections).searched, 0) << "no time: it says so";
}

TEST(Diagnose, ProgressEndsItAtEachStep) {
    PolygonMesh mesh = cube();
    append(mesh, cube(1, DVec3(0.7, 0.6, 0.5)));
    int calls = 0, last = 1000;
    DiagnoseOptions how;
    how.progress = [&](double) { return ++calls < last; };
    EXPECT_FALSE(diagnose(jobs(), mesh, how).stopped);
    const int all = calls;
    EXPECT_GE(all, 5);
    for (last = 1; last <= all; ++last) {
        calls = 0;
        EXPECT_TRUE(diagnose(jobs(), mesh, how).stopped) << last;
        EXPECT_EQ(calls, last);
    }
}

TEST(Diagnose, TakesRoundingForNoHazard) {
    // A slab that stands on a plane in any direction: its corners are up to 2^-53 off.
    const auto placed = [](const DVec3& p) {
        return DVec3(0.36 * p.x + 0.48 * p.y - 0.8 * p.z, -0.8 * p.x + 0.6 * p.y,
                     0.48 * p.x + 0.64 * p.y + 0.6 * p.z);
    };
    PolygonMesh mesh;
    mesh.positions = {{-3, -2, 0}, {2, -3, 0}, {3, 2, 0}, {-2, 3, 0},
                      {-1, 0, 0},  {1, 0, 0},  {0, 0, 1}, {0, 0, -1e-9}};
    for (DVec3& p : mesh.positions)
        p = placed(p);
    add_face(mesh, {0, 1, 2, 3});
    add_face(mesh, {4, 5, 6});
    add_face(mesh, {4, 7, 6}); // its lowest corner is 1e-9 under the plane
    EXPECT_EQ(diagnosed(mesh).count(Hazard::intersections), 0U);
    mesh.positions[7] = placed({0, 0, -1e-4});
    EXPECT_GT(diagnosed(mesh).count(Hazard::intersections), 0U);
    // Positions that are one float are one place.
    mesh = cube();
    mesh.positions.push_back(mesh.positions[0] + DVec3(1e-17, 3e-16, 0));
    mesh.corners[0].position = 8;
    EXPECT_EQ(hazards_of(diagnosed(mesh)), Hazards());
}

TEST(Diagnose, TakesMeshesWithoutFaces) {
    EXPECT_EQ(hazards_of(diagnosed(PolygonMesh())), Hazards());
    PolygonMesh points;
    points.positions = {{0, 0, 0}, {1, 1, 1}};
    points.point_vertices = {0, 1};
    points.point_material = {-1, -1};
    EXPECT_EQ(hazards_of(diagnosed(points)), Hazards());
}

TEST(Diagnose, DoesNotDependOnTheNumberOfThreads) {
    const PolygonMesh mesh = soup(7, 60, 300, false);
    Jobs alone(1), four(4);
    const Diagnosis a = diagnose(alone, mesh, {}), b = diagnose(four, mesh, {});
    EXPECT_EQ(a.marks, b.marks);
    ASSERT_EQ(hazards_of(a), hazards_of(b));
    EXPECT_GT(a.findings.size(), 3U);
    for (std::size_t i = 0; i < a.findings.size(); ++i) {
        EXPECT_EQ(a.findings[i].count, b.findings[i].count);
        EXPECT_EQ(a.findings[i].measure, b.findings[i].measure);
        EXPECT_EQ(a.findings[i].worst.face, b.findings[i].worst.face);
        EXPECT_EQ(a.findings[i].worst.at, b.findings[i].worst.at);
    }
}

} // namespace
} // namespace scanout::geom::testing
