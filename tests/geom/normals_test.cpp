#include "geom/meshes.h"
#include "geom/normals.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::geom {
namespace {

using testing::add_face;
using testing::cube;
using testing::reordered;
using testing::soup;

constexpr double kPi = 3.14159265358979323846;

// One normal a corner.
std::vector<Vec3> normals_of(PolygonMesh mesh, double crease_degrees = 60) {
    make_normals(testing::jobs(), mesh, std::vector<bool>(mesh.faces(), true), crease_degrees);
    std::vector<Vec3> normals;
    for (const Corner& c : mesh.corners)
        normals.push_back(mesh.normals.at(static_cast<std::size_t>(c.normal)));
    return normals;
}

double length_of(const DVec3& v) {
    return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

double distance(const Vec3& a, const DVec3& b) {
    return length_of(DVec3(a) - b);
}

bool all_unit(const std::vector<Vec3>& normals) {
    return std::all_of(normals.begin(), normals.end(),
                       [](const Vec3& n) { return std::abs(length_of(DVec3(n)) - 1) <= 1e-6; });
}

RC_GTEST_PROP(Normals, TheOrderOfFacesMovesNoBit, (std::uint32_t seed, bool with_groups)) {
    const PolygonMesh mesh = soup(seed, 12, 60, with_groups);
    std::vector<std::size_t> order(mesh.faces());
    std::iota(order.begin(), order.end(), 0u);
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    const std::vector<Vec3> before = normals_of(mesh);
    const PolygonMesh shuffled = reordered(mesh, order);
    const std::vector<Vec3> after = normals_of(shuffled);
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t c = 0; c < shuffled.face_end(i) - shuffled.face_begin[i]; ++c)
            RC_ASSERT(after[shuffled.face_begin[i] + c] == before[mesh.face_begin[order[i]] + c]);
}

RC_GTEST_PROP(Normals, AreOfUnitLengthWhateverTheFileSays, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    PolygonMesh mesh = soup(seed, 6, 40, true); // many faces have a corner twice
    constexpr float kBig = std::numeric_limits<float>::max();
    const std::array<float, 7> odd{0, 1, -kBig, kBig, NAN, HUGE_VALF, 1e-45f};
    for (int i = 0; i < 30; ++i)
        mesh.normals.push_back({odd[random() % 7], odd[random() % 7], odd[random() % 7]});
    for (Corner& c : mesh.corners)
        c.normal = static_cast<int>(random() % 31) - 1;
    RC_ASSERT(all_unit(normals_of(mesh)));
}

RC_GTEST_PROP(Normals, AMirroredMeshHasMirroredNormals, (std::uint32_t seed)) {
    const PolygonMesh mesh = soup(seed, 40, 30, false);
    PolygonMesh mirrored = mesh;
    for (DVec3& p : mirrored.positions)
        p.x = -p.x;
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        std::reverse(mirrored.corners.begin() + mesh.face_begin[f],
                     mirrored.corners.begin() + static_cast<std::ptrdiff_t>(mesh.face_end(f)));
    const std::vector<Vec3> a = normals_of(mesh), b = normals_of(mirrored);
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        for (std::size_t c = mesh.face_begin[f], m = mesh.face_end(f); c < mesh.face_end(f); ++c)
            RC_ASSERT(distance(a[c], DVec3(b[--m]) * DVec3(-1, 1, 1)) < 1e-5 ||
                      a[c] == Vec3(0, 0, 1));
}

// The definition, written down plainly: over all faces at the position whose normal is within the
// crease angle of this corner's face, the sum of normal times angle. Faces' normals are whole
// numbers of 2^-30, which decides of two that meet at the crease angle itself.
DVec3 by_definition(const std::vector<DVec3>& ring, std::size_t face, double crease_degrees) {
    const std::size_t n = ring.size();
    const auto normal = [&](std::size_t i) {
        const DVec3 c = cross3(ring[i], ring[(i + 1) % n]);
        const auto whole = [](double x) { return std::round(x * 0x1p30) * 0x1p-30; };
        return DVec3(whole(c.x / length_of(c)), whole(c.y / length_of(c)),
                     whole(c.z / length_of(c)));
    };
    DVec3 sum(0);
    for (std::size_t i = 0; i < n; ++i) {
        if (dot3(normal(i), normal(face)) < std::cos((crease_degrees + 0.01) * kPi / 180)) continue;
        const DVec3 &a = ring[i], &b = ring[(i + 1) % n];
        sum += normal(i) * std::acos(dot3(a, b) / length_of(a) / length_of(b));
    }
    return sum / length_of(sum);
}

PolygonMesh fan(const std::vector<DVec3>& ring) {
    PolygonMesh mesh;
    mesh.positions = ring;
    mesh.positions.push_back(DVec3(0));
    const auto n = static_cast<std::int32_t>(ring.size());
    for (std::int32_t i = 0; i < n; ++i)
        add_face(mesh, {n, i, (i + 1) % n});
    return mesh;
}

RC_GTEST_PROP(Normals, AFansHubFollowsTheDefinition, (std::uint32_t seed)) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0.2, 1);
    std::vector<DVec3> ring(*rc::gen::inRange<std::size_t>(3, 30));
    const double up = 2 * uniform(random) - 0.4;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const double angle = 2 * kPi * static_cast<double>(i) / static_cast<double>(ring.size());
        ring[i] =
            DVec3(std::cos(angle), std::sin(angle), up * uniform(random)) * 0.5 * uniform(random);
    }
    for (const double crease : {0.0, 30.0, 60.0, 120.0, 180.0}) {
        const std::vector<Vec3> normals = normals_of(fan(ring), crease);
        for (std::size_t face = 0; face < ring.size(); ++face)
            RC_ASSERT(distance(normals[face * 3], by_definition(ring, face, crease)) < 1e-6);
    }
}

TEST(Normals, ACubesEdgesAreSharpByTheCreaseAngle) {
    const PolygonMesh mesh = cube();
    const std::vector<Vec3> normals = normals_of(mesh);
    const std::array<Vec3, 6> expected{Vec3{0, 0, -1}, {0, 0, 1},  {0, -1, 0},
                                       {0, 1, 0},      {-1, 0, 0}, {1, 0, 0}};
    for (std::size_t c = 0; c < normals.size(); ++c)
        EXPECT_EQ(normals[c], expected[c / 4]);
}

TEST(Normals, ASmoothCubesCornersPointOutwardHoweverItsFacesAreCut) {
    // Weighting by area or by number of triangles would lean towards the faces that are cut there.
    const PolygonMesh whole = cube(1, DVec3(0), 1);
    PolygonMesh cut = whole;
    cut.corners.clear();
    cut.face_begin.clear();
    cut.face_material.clear();
    cut.face_smoothing.clear();
    for (std::size_t f = 0; f < whole.faces(); ++f) {
        std::array<std::int32_t, 4> p{};
        for (std::size_t i = 0; i < 4; ++i)
            p[i] = whole.corners[whole.face_begin[f] + i].position;
        if (f % 2 == 0) std::rotate(p.begin(), p.begin() + 1, p.end());
        add_face(cut, {p[0], p[1], p[2]}, 1);
        add_face(cut, {p[0], p[2], p[3]}, 1);
    }
    for (const PolygonMesh& mesh : {whole, cut}) {
        const std::vector<Vec3> normals = normals_of(mesh);
        for (std::size_t c = 0; c < normals.size(); ++c) {
            const DVec3& p = mesh.positions[static_cast<std::size_t>(mesh.corners[c].position)];
            EXPECT_LT(distance(normals[c], p / length_of(p)), 1e-7);
        }
    }
}

TEST(Normals, FacesOfDifferentSmoothingGroupsShareNothing) {
    PolygonMesh mesh = cube(1, DVec3(0), 1);
    for (std::size_t f = 0; f < 6; ++f)
        mesh.face_smoothing[f] = f < 2 ? 1 : f < 4 ? 2 : 3;
    const std::vector<Vec3> normals = normals_of(mesh); // opposite faces have no corner in common
    EXPECT_EQ(normals, normals_of(cube()));
}

TEST(Normals, SmoothingOffIsFlatAndSmoothingOnKnowsNoCrease) {
    EXPECT_EQ(normals_of(cube(1, DVec3(0), kSmoothingOff), 180), normals_of(cube()));
    EXPECT_LT(distance(normals_of(cube(1, DVec3(0), 7), 0)[0], DVec3(-1) / std::sqrt(3.0)), 1e-7);
}

TEST(Normals, AHexagonsSidesAreWithinSixtyDegreesAllOrNone) {
    PolygonMesh mesh;
    for (int i = 0; i < 6; ++i)
        for (const double z : {-0.5, 0.5})
            mesh.positions.push_back({std::round(5e5 * std::cos(i * kPi / 3)) / 1e6,
                                      std::round(5e5 * std::sin(i * kPi / 3)) / 1e6, z});
    for (int i = 0; i < 6; ++i) {
        const int j = (i + 1) % 6;
        add_face(mesh, {2 * i, 2 * j, 2 * j + 1, 2 * i + 1});
    }
    const std::vector<Vec3> smooth = normals_of(mesh, 60), sharp = normals_of(mesh, 59);
    for (std::size_t c = 0; c < smooth.size(); ++c) {
        const DVec3 p =
            mesh.positions[static_cast<std::size_t>(mesh.corners[c].position)] * DVec3(1, 1, 0);
        EXPECT_LT(distance(smooth[c], p / length_of(p)), 1e-5);
        EXPECT_GT(distance(sharp[c], p / length_of(p)), 0.4);
    }
}

TEST(Normals, TheFilesNormalsAreKeptAndTheOthersMade) {
    PolygonMesh mesh = cube();
    mesh.normals = {{0, 3, 4}, {0, 0, 0}, {NAN, 0, 0}};
    for (int i = 0; i < 3; ++i)
        mesh.corners[static_cast<std::size_t>(i)].normal = i;
    const std::vector<Vec3> normals = normals_of(mesh);
    EXPECT_EQ(normals[0], Vec3(0, 0.6f, 0.8f));
    for (std::size_t c = 1; c < 4; ++c)
        EXPECT_EQ(normals[c], Vec3(0, 0, -1));
}

TEST(Normals, FacesThatAreLeftOutAddNothing) {
    PolygonMesh mesh = cube(1, DVec3(0), 1);
    std::vector<bool> usable(6, false);
    usable[1] = true;
    mesh.positions[0] = DVec3(NAN);
    make_normals(testing::jobs(), mesh, usable, 60);
    for (std::size_t c = 4; c < 8; ++c)
        EXPECT_EQ(mesh.normals.at(static_cast<std::size_t>(mesh.corners[c].normal)), Vec3(0, 0, 1));
}

TEST(Normals, AConcaveCornerCountsWithItsWholeAngle) {
    // An L in the plane z = 0 with its inner corner (270 degrees) at the origin, and a wall x = 0
    // on it.
    PolygonMesh mesh;
    mesh.positions = {{0, 0, 0},    {0, .5, 0}, {-.5, .5, 0}, {-.5, -.5, 0},
                      {.5, -.5, 0}, {.5, 0, 0}, {0, .5, .5},  {0, 0, .5}};
    add_face(mesh, {0, 1, 2, 3, 4, 5}, 1);
    add_face(mesh, {0, 1, 6, 7}, 1);
    const DVec3 expected = DVec3(1, 0, 3) / std::sqrt(10.0);
    EXPECT_LT(distance(normals_of(mesh)[0], expected), 1e-7);
}

TEST(Normals, ACornerWrittenTwiceCountsOnce) {
    PolygonMesh mesh = cube(1, DVec3(0), 1), doubled = mesh;
    doubled.corners.clear();
    doubled.face_begin.clear();
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        doubled.face_begin.push_back(static_cast<std::uint32_t>(doubled.corners.size()));
        for (std::size_t c = mesh.face_begin[f]; c < mesh.face_end(f); ++c)
            doubled.corners.insert(doubled.corners.end(), f == 2 ? 2 : 1, mesh.corners[c]);
    }
    for (std::size_t c = 0; c < doubled.corners.size(); ++c) {
        const DVec3& p = doubled.positions[static_cast<std::size_t>(doubled.corners[c].position)];
        EXPECT_LT(distance(normals_of(doubled)[c], p / length_of(p)), 1e-7);
    }
}

TEST(Normals, ANeedlesNormalKeepsItsDigits) {
    // Of the needle's long edges the cross product keeps 4 digits, of its shortest two all of them.
    const DVec3 a(0.123456789, 0.234567891, 0.345678912);
    const DVec3 b = a + DVec3(0.5, 0.4, 0.3), c = b + DVec3(1e-12, -2e-12, 3e-12);
    using Exact = glm::tvec3<long double>;
    const auto exact = [](const DVec3& p, const DVec3& q) { return Exact(q) - Exact(p); };
    const Exact n = cross3(exact(a, b), exact(b, c));
    const DVec3 expected(n / std::sqrt(dot3(n, n)));
    for (int start = 0; start < 3; ++start) {
        PolygonMesh mesh;
        mesh.positions = {a, b, c};
        add_face(mesh, {start, (start + 1) % 3, (start + 2) % 3});
        EXPECT_LT(distance(normals_of(mesh)[0], expected), 1e-6) << start;
    }
}

TEST(Normals, TwoSidesOfASheetDoNotCancel) {
    PolygonMesh mesh;
    mesh.positions = {{0, 0, 0}, {.5, 0, 0}, {0, .5, 0}};
    for (const std::uint32_t group : {kSmoothingUnset, 1u}) {
        mesh.corners.clear();
        mesh.face_begin.clear();
        mesh.face_smoothing.clear();
        add_face(mesh, {0, 1, 2}, group);
        add_face(mesh, {0, 2, 1}, group);
        const std::vector<Vec3> normals = normals_of(mesh);
        for (std::size_t c = 0; c < 6; ++c)
            EXPECT_EQ(normals[c], Vec3(0, 0, c < 3 ? 1 : -1));
    }
}

TEST(Normals, DegenerateFacesTakeWhatTheirNeighboursGive) {
    PolygonMesh mesh = cube();
    add_face(mesh, {0, 0, 0});
    add_face(mesh, {2, 3, 3});
    const std::vector<Vec3> normals = normals_of(mesh);
    EXPECT_TRUE(all_unit(normals));
    const std::vector<Vec3> alone = normals_of(cube());
    EXPECT_TRUE(std::equal(alone.begin(), alone.end(), normals.begin()));
    PolygonMesh point;
    point.positions = {DVec3(0)};
    add_face(point, {0, 0, 0});
    EXPECT_EQ(normals_of(point), std::vector<Vec3>(3, Vec3(0, 0, 1)));
}

TEST(Normals, AHubOfTwentyThousandFacesIsStillDividedByTheCrease) {
    // A steep cone: normals all around, so pairs decide. Each corner's normal leans to its own
    // side.
    std::vector<DVec3> ring(20000);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const double angle = 2 * kPi * static_cast<double>(i) / static_cast<double>(ring.size());
        ring[i] = {0.1 * std::cos(angle), 0.1 * std::sin(angle), -0.9};
    }
    const std::vector<Vec3> normals = normals_of(fan(ring));
    EXPECT_TRUE(all_unit(normals));
    for (std::size_t i = 0; i < ring.size(); i += 97) {
        const DVec3 own = cross3(ring[i], ring[(i + 1) % ring.size()]);
        EXPECT_LT(distance(normals[3 * i], own / length_of(own)), 0.25);
    }
}

} // namespace
} // namespace scanout::geom
