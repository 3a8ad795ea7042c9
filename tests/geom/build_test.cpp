#include "geom/build.h"
#include "geom/meshes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <tuple>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace scanout::geom {
namespace {

using testing::add_face;
using testing::cube;
using testing::reordered;
using testing::soup;

BuildResult build(PolygonMesh polygons) {
    Warnings warnings;
    return build_mesh(std::move(polygons), {}, "test.obj", warnings);
}

using VertexKey = std::array<float, 11>;

VertexKey key(const Mesh& m, std::uint32_t i) {
    VertexKey k{m.position[i].x, m.position[i].y, m.position[i].z,
                m.normal[i].x,   m.normal[i].y,   m.normal[i].z};
    if (!m.uv.empty()) k[6] = m.uv[i].x, k[7] = m.uv[i].y;
    if (!m.colour.empty()) k[8] = m.colour[i].x, k[9] = m.colour[i].y, k[10] = m.colour[i].z;
    return k;
}

bool same_drawing(const Mesh& a, const Mesh& b) {
    return a.position == b.position && a.normal == b.normal && a.uv == b.uv &&
           a.colour == b.colour && a.index == b.index && a.material == b.material &&
           a.face == b.face && a.radius == b.radius;
}

// A soup with everything: uvs, colours, some normals, lines and points.
PolygonMesh full_soup(std::uint32_t seed) {
    PolygonMesh mesh = soup(seed, 12, 40, true);
    std::mt19937 random(seed);
    const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
    for (int i = 0; i < 5; ++i)
        mesh.uvs.push_back({below(3) - 1, below(3) / 2.0});
    for (int i = 0; i < 4; ++i)
        mesh.normals.push_back({below(3) - 1, below(3) - 1, below(3) - 1});
    for (int i = 0; i < 12; ++i)
        mesh.colours.push_back(Vec3(static_cast<float>(below(2)), 0.5f, 0));
    for (Corner& c : mesh.corners) {
        c.uv = below(6) - 1;
        c.normal = below(5) - 1;
    }
    for (std::uint32_t i = 0; i < 9; ++i) {
        if (i % 3 == 0) {
            mesh.line_begin.push_back(i);
            mesh.line_material.push_back(static_cast<std::int32_t>(i));
        }
        mesh.line_vertices.push_back(i);
        mesh.point_vertices.push_back(11 - i);
        mesh.point_material.push_back(2);
    }
    return mesh;
}

RC_GTEST_PROP(Build, KeepsEveryFaceInFileOrder, (std::uint32_t seed)) {
    const PolygonMesh polygons = full_soup(seed);
    const Mesh m = build(polygons).mesh;
    RC_ASSERT(m.index.size() == 3 * m.face.size() && m.material.size() == m.face.size());
    RC_ASSERT(std::is_sorted(m.face.begin(), m.face.end()));
    for (std::size_t f = 0; f < polygons.faces(); ++f) {
        const auto [first, last] = std::equal_range(m.face.begin(), m.face.end(), f);
        RC_ASSERT(static_cast<std::size_t>(last - first) ==
                  polygons.face_end(f) - polygons.face_begin[f] - 2);
        for (auto t = first; t != last; ++t)
            RC_ASSERT(m.material[static_cast<std::size_t>(t - m.face.begin())] ==
                      polygons.face_material[f]);
    }
}

RC_GTEST_PROP(Build, NoTwoVerticesAreEqualAndAllAreUsedInOrder, (std::uint32_t seed)) {
    const Mesh m = build(full_soup(seed)).mesh;
    std::set<VertexKey> seen;
    for (std::uint32_t i = 0; i < m.position.size(); ++i)
        RC_ASSERT(seen.insert(key(m, i)).second);
    std::uint32_t next = 0; // by the faces' corners in file order, then lines, then points
    const auto use = [&](std::uint32_t i) {
        RC_ASSERT(i <= next);
        next = std::max(next, i + 1);
    };
    for (std::size_t t = 0, end = 0; t < m.triangles(); t = end) {
        while (end < m.triangles() && m.face[end] == m.face[t])
            ++end;
        std::set<std::uint32_t> of_face(m.index.data() + 3 * t, m.index.data() + 3 * end);
        std::for_each(of_face.begin(), of_face.end(), use);
    }
    std::for_each(m.line_index.begin(), m.line_index.end(), use);
    std::for_each(m.point_index.begin(), m.point_index.end(), use);
    RC_ASSERT(next == m.position.size());
    RC_ASSERT(m.normal.size() == next && m.uv.size() == next && m.colour.size() == next);
}

RC_GTEST_PROP(Build, EveryTriangleCornerIsACornerOfItsFace, (std::uint32_t seed)) {
    const PolygonMesh polygons = full_soup(seed);
    const Mesh m = build(polygons).mesh;
    const double scale = std::ldexp(1, -m.exponent);
    for (std::size_t t = 0; t < m.triangles(); ++t)
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t v = m.index[3 * t + i];
            bool found = false;
            for (std::size_t c = polygons.face_begin[m.face[t]]; c < polygons.face_end(m.face[t]);
                 ++c) {
                const Corner& corner = polygons.corners[c];
                const auto p = static_cast<std::size_t>(corner.position);
                const Vec2 uv = corner.uv < 0
                                    ? Vec2(0)
                                    : Vec2(polygons.uvs[static_cast<std::size_t>(corner.uv)]);
                found |= m.position[v] == Vec3((polygons.positions[p] - m.centre) * scale) &&
                         m.uv[v] == uv && m.colour[v] == polygons.colours[p];
            }
            RC_ASSERT(found);
        }
}

RC_GTEST_PROP(Build, TheOrderOfFacesChangesNoTriangle, (std::uint32_t seed)) {
    const PolygonMesh polygons = full_soup(seed);
    std::vector<std::size_t> order(polygons.faces());
    std::iota(order.begin(), order.end(), 0u);
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    const auto triangles = [](const Mesh& m, auto&& face_of) {
        std::multiset<std::pair<std::size_t, std::array<VertexKey, 3>>> all;
        for (std::size_t t = 0; t < m.triangles(); ++t)
            all.insert(
                {face_of(m.face[t]),
                 {key(m, m.index[3 * t]), key(m, m.index[3 * t + 1]), key(m, m.index[3 * t + 2])}});
        return all;
    };
    const Mesh a = build(polygons).mesh, b = build(reordered(polygons, order)).mesh;
    RC_ASSERT(triangles(a, [](std::uint32_t f) -> std::size_t { return f; }) ==
              triangles(b, [&](std::uint32_t f) { return order[f]; }));
}

RC_GTEST_PROP(Build, APowerOfTwoChangesTheExponentAlone, (std::uint32_t seed)) {
    const PolygonMesh polygons = full_soup(seed);
    const Mesh m = build(polygons).mesh;
    for (const int k : {-1000, -50, 1, 50, 1000}) {
        PolygonMesh scaled = polygons;
        for (DVec3& p : scaled.positions)
            p = DVec3(std::ldexp(p.x, k), std::ldexp(p.y, k), std::ldexp(p.z, k));
        const Mesh n = build(std::move(scaled)).mesh;
        RC_ASSERT(same_drawing(m, n) && n.exponent == m.exponent + k);
    }
}

RC_GTEST_PROP(Build, AnExactTranslationChangesTheCentreAlone, (std::uint32_t seed)) {
    PolygonMesh polygons = full_soup(seed);
    for (DVec3& p : polygons.positions)
        p = DVec3(std::round(p.x * 1000), std::round(p.y * 1000), std::round(p.z * 1000));
    const Mesh m = build(polygons).mesh;
    for (DVec3& p : polygons.positions)
        p += DVec3(581311, 4785270, -1e9);
    RC_ASSERT(same_drawing(m, build(polygons).mesh));
}

RC_GTEST_PROP(Build, AnyNumbersGiveFiniteVerticesOfUnitSize, (std::uint32_t seed)) {
    PolygonMesh polygons = full_soup(seed);
    std::mt19937 random(seed);
    constexpr double kMax = std::numeric_limits<double>::max();
    const std::array<double, 9> odd{NAN, HUGE_VAL, -HUGE_VAL, kMax, -kMax, 5e-324, -0.0, 1e40, 1};
    for (DVec3& p : polygons.positions)
        if (random() % 2 == 0) p[static_cast<int>(random() % 3)] = odd[random() % 9];
    for (DVec2& uv : polygons.uvs)
        uv.x = odd[random() % 9];
    for (Vec3& c : polygons.colours)
        if (random() % 2 == 0) c.y = static_cast<float>(random() % 2 == 0 ? NAN : HUGE_VALF);
    const std::size_t faces = polygons.faces();
    const BuildResult r = build(std::move(polygons));
    for (std::uint32_t i = 0; i < r.mesh.position.size(); ++i) {
        for (const float x : key(r.mesh, i))
            RC_ASSERT(std::isfinite(x));
        for (int axis = 0; axis < 3; ++axis)
            RC_ASSERT(std::abs(r.mesh.position[i][axis]) <= 1);
    }
    const std::set<std::uint32_t> drawn(r.mesh.face.begin(), r.mesh.face.end());
    RC_ASSERT(drawn.size() + r.skipped_faces == faces);
}

// Kept: every compiler, CPU and optimisation must give these bits. A change here changes every
// frame.
TEST(Build, GivesTheSameBitsEverywhere) {
    std::uint64_t hash = 14695981039346656037u; // FNV-1a
    const auto add = [&](std::uint32_t bits) { hash = (hash ^ bits) * 1099511628211u; };
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
        const Mesh m = build(soup(seed, 40, 300, seed % 2 == 1)).mesh;
        for (std::uint32_t i = 0; i < m.position.size(); ++i)
            for (const float x : key(m, i))
                add(std::bit_cast<std::uint32_t>(x));
        std::for_each(m.index.begin(), m.index.end(), add);
        add(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(m.radius) >> 20));
    }
    EXPECT_EQ(hash, 17081462927132053159u);
}

// Large enough for several blocks of everything, and for a table in parts.
PolygonMesh large_soup(std::uint32_t seed) {
    PolygonMesh m = soup(seed, 9000, 50'000, seed % 2 == 0);
    std::mt19937 random(seed);
    for (int i = 0; i < 500; ++i) {
        m.uvs.push_back({i / 7.0 + (i % 50 == 0 ? 1000 : 0), i % 13});
        m.normals.push_back(i % 9 == 0 ? Vec3(0) : Vec3(i % 5 - 2, i % 7 - 3, 1));
    }
    for (Corner& c : m.corners) {
        c.uv = static_cast<std::int32_t>(random() % 501) - 1;
        c.normal = random() % 3 == 0 ? static_cast<std::int32_t>(random() % 500) : -1;
    }
    for (std::size_t p = 0; p < m.positions.size(); p += 997)
        m.positions[p].y = std::numeric_limits<double>::infinity();
    for (std::uint32_t p = 0; p < 9000; p += 3) {
        m.point_vertices.push_back(p);
        m.point_material.push_back(static_cast<std::int32_t>(p % 4));
        m.line_begin.push_back(static_cast<std::uint32_t>(m.line_vertices.size()));
        m.line_vertices.insert(m.line_vertices.end(), {p, p + 1, p + 2});
        m.line_material.push_back(1);
    }
    return m;
}

TEST(Build, TheNumberOfThreadsChangesNothing) {
    for (const std::uint32_t seed : {1u, 2u}) {
        const BuildResult alone = build(large_soup(seed));
        EXPECT_GT(alone.skipped_faces, 100u);
        EXPECT_GT(alone.skipped_points, 1u);
        for (const int threads : {2, 3, 16}) {
            Jobs jobs(threads);
            Warnings warnings;
            const BuildResult r =
                build_mesh(large_soup(seed), {.jobs = &jobs}, "test.obj", warnings);
            const Mesh &a = alone.mesh, &b = r.mesh;
            EXPECT_EQ(a.position, b.position);
            EXPECT_EQ(a.normal, b.normal);
            EXPECT_EQ(a.uv, b.uv);
            EXPECT_EQ(a.index, b.index);
            EXPECT_EQ(a.material, b.material);
            EXPECT_EQ(a.face, b.face);
            EXPECT_EQ(a.line_index, b.line_index);
            EXPECT_EQ(a.point_index, b.point_index);
            EXPECT_EQ(a.line_faces.triangle, b.line_faces.triangle);
            EXPECT_EQ(a.centre, b.centre);
            EXPECT_EQ(a.radius, b.radius);
            EXPECT_EQ(std::tuple(alone.skipped_faces, alone.skipped_lines, alone.skipped_points),
                      std::tuple(r.skipped_faces, r.skipped_lines, r.skipped_points));
            EXPECT_EQ(warnings.lines().size(), 3u);
        }
    }
}

TEST(Build, ProgressRisesEvenlyToTheEndAndStops) {
    std::vector<double> shares;
    BuildOptions options;
    options.progress = [&](double share) {
        shares.push_back(share);
        return true;
    };
    Warnings warnings;
    const PolygonMesh large = soup(1, 80'000, 80'000, false); // several batches of each step
    EXPECT_FALSE(build_mesh(PolygonMesh(large), options, "test.obj", warnings).stopped);
    ASSERT_GE(shares.size(), 5u);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_GE(shares.front(), 0);
    EXPECT_LT(shares.back(), 1);
    for (std::size_t i = 1; i < shares.size(); ++i)
        EXPECT_LT(shares[i] - shares[i - 1], 0.25);
    for (std::size_t most = 1; most <= shares.size(); ++most) {
        std::size_t calls = 0;
        options.progress = [&](double) { return ++calls < most; };
        EXPECT_TRUE(build_mesh(PolygonMesh(large), options, "test.obj", warnings).stopped);
        EXPECT_EQ(calls, most) << "what was stopped must not go on";
    }
}

TEST(Build, JoinsMinusZeroAndZero) {
    PolygonMesh polygons;
    polygons.positions = {{0.0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {-0.0, -0.0, 0}, {2, -2, 0}};
    polygons.uvs = {{-0.0, 0.0}, {0.0, -0.0}};
    add_face(polygons, {0, 1, 2});
    add_face(polygons, {3, 4, 1});
    for (std::size_t c = 0; c < 6; ++c)
        polygons.corners[c].uv = c < 3 ? 0 : 1;
    EXPECT_EQ(build(polygons).mesh.position.size(), 4u);
    // About their middle the zeros above are not zeros any more: here they stay.
    polygons.positions = {{0.0, -0.0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0.0, -0.0}, {-1, -1, 0}};
    EXPECT_EQ(build(polygons).mesh.position.size(), 4u);
}

// HARD-CASES 58
TEST(Build, LeavesOutWhatIsNotFiniteAndCountsIt) {
    PolygonMesh polygons = cube();
    polygons.positions.push_back({NAN, 0, 0});
    polygons.positions.push_back({0, HUGE_VAL, 0});
    add_face(polygons, {0, 1, 8});
    add_face(polygons, {9, 1, 2, 3});
    add_face(polygons, {0, 1}); // too few corners
    polygons.line_vertices = {0, 1, 2, 0, 8, 1};
    polygons.line_begin = {0, 3};
    polygons.line_material = {-1, -1};
    polygons.point_vertices = {3, 9};
    polygons.point_material = {-1, -1};
    Warnings warnings;
    const BuildResult r = build_mesh(std::move(polygons), {}, "half.obj", warnings);
    EXPECT_EQ(r.skipped_faces, 3u);
    EXPECT_EQ(r.skipped_lines, 1u);
    EXPECT_EQ(r.skipped_points, 1u);
    EXPECT_EQ(r.mesh.triangles(), 12u);
    EXPECT_EQ(r.mesh.lines(), 2u);
    EXPECT_EQ(r.mesh.points(), 1u);
    EXPECT_EQ(r.mesh.box_max, DVec3(1));
    ASSERT_EQ(warnings.lines().size(), 3u);
    EXPECT_TRUE(warnings.lines()[0].starts_with("half.obj: 3 faces not drawn"))
        << warnings.lines()[0];
}

TEST(Build, KeepsDegenerateFaces) {
    PolygonMesh polygons;
    polygons.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (const auto& corners :
         {std::vector<std::int32_t>{0, 1, 2}, {0, 0, 1}, {2, 2, 2}, {0, 1, 2, 1}})
        add_face(polygons, corners);
    const BuildResult r = build(std::move(polygons));
    EXPECT_EQ(r.skipped_faces, 0u);
    EXPECT_EQ(r.mesh.triangles(), 5u);
}

TEST(Build, FramesOnlyWhatIsDrawn) {
    PolygonMesh polygons = cube();
    polygons.positions.push_back({1e6, 0, 0}); // nothing uses it
    const Mesh m = build(polygons).mesh;
    EXPECT_EQ(m.centre, DVec3(0));
    EXPECT_EQ(m.box_max, DVec3(1));
    EXPECT_DOUBLE_EQ(std::ldexp(m.radius, m.exponent), std::sqrt(3.0));
    polygons.point_vertices = {8};
    polygons.point_material = {-1};
    EXPECT_EQ(build(polygons).mesh.box_max, DVec3(1e6, 1, 1));
}

TEST(Build, AnEmptyMeshIsAMesh) {
    const Mesh m = build({}).mesh;
    EXPECT_TRUE(m.position.empty());
    EXPECT_EQ(m.radius, 0.5);
    PolygonMesh vertices;
    vertices.positions = {{0, 0, 0}, {8, 0, 0}};
    EXPECT_EQ(build(vertices).mesh.centre, DVec3(4, 0, 0));
}

TEST(Build, AModelFarFromTheOriginKeepsItsShape) {
    // UTM coordinates: floats there are half a metre apart (HARD-CASES 20).
    PolygonMesh near = soup(3, 50, 80, false), far = near;
    for (DVec3& p : far.positions)
        p += DVec3(581311.25, 4785270.5, 937.3);
    const Mesh a = build(std::move(near)).mesh, b = build(std::move(far)).mesh;
    ASSERT_EQ(a.position.size(), b.position.size());
    for (std::size_t i = 0; i < a.position.size(); ++i)
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(a.position[i][axis], b.position[i][axis], 2e-7);
}

TEST(Build, ManyRepeatsOfATextureKeepTheirDigits) {
    // 1e5 repeats of 1024 texels: as floats the uvs would be 8 texels apart (HARD-CASES 36).
    PolygonMesh polygons = cube();
    const DVec2 base(100'000, -70'000);
    for (int i = 0; i < 4; ++i)
        polygons.uvs.push_back(base + DVec2(i % 2 * 1.37, i / 2 * 0.731) + 0.123456789);
    for (std::size_t c = 0; c < polygons.corners.size(); ++c)
        polygons.corners[c].uv = static_cast<int>(c % 4);
    const std::vector<DVec2> uvs = polygons.uvs;
    const Mesh m = build(std::move(polygons)).mesh;
    const Vec2 first = m.uv[m.index[0]];
    for (const std::uint32_t i : {m.index[1], m.index[2], m.index[5]}) {
        const DVec2 moved(m.uv[i] - first);
        bool found = false;
        for (const DVec2& uv : uvs)
            found |= std::abs(moved.x - (uv - uvs[0]).x) < 1e-6 &&
                     std::abs(moved.y - (uv - uvs[0]).y) < 1e-6;
        EXPECT_TRUE(found);
    }
    const double whole = uvs[0].x - static_cast<double>(first.x);
    EXPECT_LT(std::abs(whole - std::round(whole)), 1.0 / 256 / 1024);
    EXPECT_LT(std::abs(first.x), 2);
}

TEST(Build, ManyRepeatsInAFaceAreKeptAsTheFileSays) {
    PolygonMesh polygons = cube();
    polygons.uvs = {{0.1, 0.2}, {100'000.123456789, 0.2}, {100'000.123456799, 7'000.3}};
    for (std::size_t c = 0; c < polygons.corners.size(); ++c)
        polygons.corners[c].uv = static_cast<int>(c % 3);
    const std::vector<DVec2> uvs = polygons.uvs;
    const Mesh m = build(std::move(polygons)).mesh;
    ASSERT_EQ(m.exact_uv.size(), m.uv.size()); // floats of the last two are one
    for (std::uint32_t i = 0; i < m.uv.size(); ++i) {
        EXPECT_EQ(m.uv[i], Vec2(m.uv_of(i)));
        EXPECT_TRUE(std::find(uvs.begin(), uvs.end(), m.uv_of(i)) != uvs.end());
    }
    EXPECT_NE(std::find(m.exact_uv.begin(), m.exact_uv.end(), uvs[1]), m.exact_uv.end());
    EXPECT_NE(std::find(m.exact_uv.begin(), m.exact_uv.end(), uvs[2]), m.exact_uv.end());
}

TEST(Build, FewRepeatsNeedNoMoreThanFloats) {
    PolygonMesh polygons = cube();
    polygons.uvs = {{0.1, 0.2}, {64, -64}, {1e9, 1e9}}; // no face uses the last one
    for (std::size_t c = 0; c < polygons.corners.size(); ++c)
        polygons.corners[c].uv = static_cast<int>(c % 2);
    const Mesh m = build(std::move(polygons)).mesh;
    EXPECT_FALSE(m.uv.empty());
    EXPECT_TRUE(m.exact_uv.empty());
}

TEST(Build, ManyRepeatsAreMovedByWholeStepsOfTheMaterial) {
    for (const DVec2& step : {DVec2(2), DVec2(20, 0), DVec2(0, 40)}) {
        PolygonMesh polygons = cube();
        polygons.uvs = {{1013.25, -787.5}};
        for (Corner& c : polygons.corners)
            c.uv = 0;
        for (std::int32_t& material : polygons.face_material)
            material = 1;
        Warnings warnings;
        BuildOptions options;
        options.uv_step = {DVec2(0), step};
        const Mesh m = build_mesh(std::move(polygons), options, "cube", warnings).mesh;
        const Vec2 uv = m.uv[0];
        const auto moved = [](double from, float to, double by) {
            if (by == 0) return static_cast<double>(to) == from;
            const double steps = (from - static_cast<double>(to)) / by;
            return steps == std::round(steps) && to >= 0 && static_cast<double>(to) < by;
        };
        EXPECT_TRUE(moved(1013.25, uv.x, step.x)) << uv.x;
        EXPECT_TRUE(moved(-787.5, uv.y, step.y)) << uv.y;
    }
}

TEST(Build, FewRepeatsOfATextureStayAsTheFileSays) {
    PolygonMesh polygons = cube();
    polygons.uvs = {{63.5, -60}};
    for (Corner& c : polygons.corners)
        c.uv = 0;
    EXPECT_EQ(build(std::move(polygons)).mesh.uv[0], Vec2(63.5f, -60));
}

TEST(Build, UvsAndColoursAreEmptyWhenNothingHasThem) {
    PolygonMesh polygons = cube();
    polygons.uvs = {{1, 1}}; // given, but no face uses it
    const Mesh m = build(std::move(polygons)).mesh;
    EXPECT_TRUE(m.uv.empty());
    EXPECT_TRUE(m.colour.empty());
    EXPECT_EQ(m.position.size(), 24u); // sharp edges
}

TEST(Build, VerticesOfDifferentColourStayApart) {
    PolygonMesh polygons;
    polygons.positions = {{2, 0, 0}, {0, 2, 0}};
    polygons.colours = {Vec3(0), Vec3(0)};
    for (int i = 0; i < 1000; ++i) { // so many that some meet in the table
        polygons.positions.push_back({0, 0, 0});
        polygons.colours.push_back(Vec3(static_cast<float>(i), 1, 0));
        add_face(polygons, {0, 1, i + 2});
    }
    const Mesh m = build(std::move(polygons)).mesh;
    ASSERT_EQ(m.position.size(), 1002u);
    for (std::size_t t = 0; t < 1000; ++t)
        EXPECT_EQ(m.colour[m.index[3 * t + 2]].x, static_cast<float>(t));
}

TEST(Build, LinesAndPointsHaveVerticesOfTheirOwn) {
    PolygonMesh polygons;
    polygons.positions = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}};
    polygons.line_vertices = {0, 1, 2};
    polygons.line_begin = {0};
    polygons.line_material = {4};
    polygons.point_vertices = {1, 1};
    polygons.point_material = {5, 6};
    const Mesh m = build(std::move(polygons)).mesh;
    EXPECT_EQ(m.line_index, (std::vector<std::uint32_t>{0, 1, 1, 2}));
    EXPECT_EQ(m.line_material, (std::vector<std::int32_t>{4, 4}));
    EXPECT_EQ(m.point_index, (std::vector<std::uint32_t>{1, 1}));
    EXPECT_EQ(m.point_material, (std::vector<std::int32_t>{5, 6}));
    EXPECT_EQ(m.position.size(), 3u);
    EXPECT_EQ(m.normal[0], Vec3(0, 0, 1));
}

} // namespace
} // namespace scanout::geom
