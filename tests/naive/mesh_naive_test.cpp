// Meshes on which the usual way fails and ours does not: normals of what has none, areas of
// needles, polygons seen from their side, vertices at -0 (HARD-CASES 28, 29, 53, 63).
#include "geom/build.h"
#include "geom/meshes.h"
#include "geom/normals.h"
#include "geom/triangulate.h"

#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <random>
#include <string>

#include <gtest/gtest.h>

namespace scanout::naive {
namespace {

using geom::Corner;
using geom::PolygonMesh;
using geom::testing::add_face;

void record_number(const std::string& name, double value) {
    testing::Test::RecordProperty(name, testing::PrintToString(value));
}

double length_of(const DVec3& v) {
    return std::sqrt(dot3(v, v));
}

// HARD-CASES 28: sums of cross products, divided by their length, whatever that is.
std::vector<DVec3> usual_normals(const PolygonMesh& m) {
    std::vector<DVec3> sum(m.positions.size(), DVec3(0));
    for (std::size_t f = 0; f < m.faces(); ++f) {
        const auto at = [&](std::size_t i) {
            return static_cast<std::size_t>(m.corners[m.face_begin[f] + i].position);
        };
        const DVec3& a = m.positions[at(0)];
        const DVec3 normal = cross3(m.positions[at(1)] - a, m.positions[at(2)] - a);
        for (std::size_t c = m.face_begin[f]; c < m.face_end(f); ++c)
            sum[static_cast<std::size_t>(m.corners[c].position)] += normal;
    }
    for (DVec3& n : sum)
        n /= length_of(n);
    return sum;
}

TEST(Row28, NormalsOfWhatHasNoneAreUnitAndTheUsualOnesAreNotNumbers) {
    std::mt19937 random(28);
    constexpr float kBig = 3e38F;
    const std::array<float, 7> odd{0, 1, -kBig, kBig, NAN, HUGE_VALF, 1e-45F};
    int usual = 0, ours = 0, corners = 0;
    double worst = 0;
    for (unsigned seed = 0; seed < 400; ++seed) {
        PolygonMesh mesh = geom::testing::soup(seed, 5, 12, seed % 2 == 0);
        add_face(mesh, {0, 0, 0});
        add_face(mesh, {1, 2, 1});
        for (const DVec3& n : usual_normals(mesh))
            usual += std::isfinite(n.x + n.y + n.z) ? 0 : 1;
        for (int i = 0; i < 30; ++i)
            mesh.normals.push_back({odd[random() % 7], odd[random() % 7], odd[random() % 7]});
        for (Corner& c : mesh.corners)
            c.normal = static_cast<int>(random() % 31) - 1;
        geom::make_normals(geom::testing::jobs(), mesh, std::vector<bool>(mesh.faces(), true), 60);
        for (const Corner& c : mesh.corners) {
            const double size =
                length_of(DVec3(mesh.normals.at(static_cast<std::size_t>(c.normal))));
            ours += std::isfinite(size) ? 0 : 1;
            worst = std::max(worst, std::abs(size - 1));
            ++corners;
        }
    }
    EXPECT_EQ(ours, 0);
    EXPECT_LE(worst, 1e-6);
    EXPECT_GT(usual, 20);
    record_number("usual_not_numbers", usual);
    record_number("our_worst_length_off_1", worst);
    record_number("corners", corners);
}

// HARD-CASES 29. Heron's formula in double on the needles of Kahan's table loses what the cross
// product of the two shortest edges keeps.
TEST(Row29, NeedlesHaveTheirDirectionAndHeronsAreaIsLost) {
    std::mt19937_64 random(29);
    std::uniform_real_distribution<double> unit(-1, 1);
    double heron_worst = 0, ours = 0;
    for (int i = 0; i < 20'000; ++i) {
        const DVec3 a = DVec3(unit(random), unit(random), unit(random)) * 0.5;
        const DVec3 b = a + DVec3(unit(random), unit(random), unit(random)) * 0.25;
        const DVec3 c = b + DVec3(unit(random), unit(random), unit(random)) * 1e-9;
        using Exact = glm::tvec3<long double>;
        const Exact exact = cross3(Exact(b) - Exact(a), Exact(c) - Exact(b));
        const long double twice = std::sqrt(dot3(exact, exact));
        const double x = length_of(b - a), y = length_of(c - b), z = length_of(a - c),
                     s = (x + y + z) / 2;
        const double heron = 2 * std::sqrt(std::max(0.0, s * (s - x) * (s - y) * (s - z)));
        heron_worst = std::max(heron_worst, static_cast<double>(std::abs(heron - twice) / twice));
        PolygonMesh mesh;
        mesh.positions = {a, b, c};
        add_face(mesh, {i % 3, (i + 1) % 3, (i + 2) % 3});
        geom::make_normals(geom::testing::jobs(), mesh, {true}, 60);
        const DVec3 n(mesh.normals.at(static_cast<std::size_t>(mesh.corners[0].normal)));
        ours = std::max(ours, length_of(n - DVec3(exact / twice)));
    }
    EXPECT_LE(ours, 1e-6); // normals are floats
    EXPECT_GT(heron_worst, 0.01);
    record_number("heron_relative", heron_worst);
    record_number("our_normal_off", ours);
}

// HARD-CASES 53: a polygon in a plane that contains the z axis is a line when z is dropped.
TEST(Row53, PolygonsAreCutInTheirOwnPlaneAndNotInXAndY) {
    std::mt19937 random(53);
    std::uniform_real_distribution<double> unit(-1, 1);
    int usual = 0, ours = 0, polygons = 0;
    for (int i = 0; i < 2000; ++i) {
        const double turn = unit(random) * 3.1;
        const DVec3 u(std::cos(turn), std::sin(turn), unit(random) * 1e-9), v(0, 0, 1);
        const int n = 4 + static_cast<int>(random() % 12);
        std::vector<DVec3> space, flat;
        for (int k = 0; k < n; ++k) { // a star, and its shadow on the ground
            const double angle = 2 * 3.14159265358979 * k / n, r = k % 2 == 0 ? 1 : 0.4;
            space.push_back(r * (u * std::cos(angle) + v * std::sin(angle)));
            flat.emplace_back(space.back().x, space.back().y, 0);
        }
        const DVec3 normal = geom::newell_normal(space);
        const auto is_flipped = [&](const std::vector<std::uint32_t>& t) {
            for (std::size_t k = 0; k < t.size(); k += 3)
                if (dot3(cross3(space[t[k + 1]] - space[t[k]], space[t[k + 2]] - space[t[k]]),
                         normal) < -1e-12)
                    return true;
            return false;
        };
        std::vector<std::uint32_t> cut, dropped;
        geom::triangulate(space, cut);
        geom::triangulate(flat, dropped);
        ours += is_flipped(cut) ? 1 : 0;
        usual += is_flipped(dropped) ? 1 : 0;
        ++polygons;
    }
    EXPECT_EQ(ours, 0);
    EXPECT_GT(usual, 500);
    record_number("flipped_when_z_is_dropped", usual);
    record_number("polygons", polygons);
}

// HARD-CASES 63: a table of bits keeps 0 and -0 apart.
TEST(Row63, VerticesAtMinusZeroAreJoinedAndTheirBitsAreNot) {
    std::mt19937 random(63);
    PolygonMesh mesh;
    for (int i = 0; i < 3000; ++i) {
        const auto any = [&] {
            const int which = static_cast<int>(random() % 4);
            return which == 0 ? -0.0 : which == 1 ? 0.0 : which == 2 ? 1.0 : -1.0;
        };
        mesh.positions.emplace_back(any(), any(), any());
    }
    for (int i = 0; i < 3000; i += 3)
        add_face(mesh, {i, i + 1, i + 2}, geom::kSmoothingOff);
    std::map<std::array<std::uint64_t, 3>, int> by_bits;
    for (const DVec3& p : mesh.positions)
        ++by_bits[{std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y),
                   std::bit_cast<std::uint64_t>(p.z)}];
    for (Corner& c : mesh.corners)
        c.normal = 0;
    mesh.normals = {Vec3(0, 0, 1)};
    Warnings warnings;
    const geom::Mesh built = geom::build_mesh(std::move(mesh), {}, "x", warnings).mesh;
    EXPECT_EQ(built.position.size(), 27U); // three values an axis
    EXPECT_EQ(by_bits.size(), 64U);
    for (const Vec3& p : built.position)
        EXPECT_EQ(p, p + Vec3(0));
}

} // namespace
} // namespace scanout::naive
