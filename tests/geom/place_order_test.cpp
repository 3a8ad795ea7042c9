#include "geom/place_order.h"
#include "support/meshes.h"
#include "support/random.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::geom {
namespace {

using test::Random;

// Everything that a triangle draws, and by what it is told from others.
struct Drawn {
    std::array<std::array<float, 6>, 3> corner; // position and normal
    std::int32_t material;
    auto operator<=>(const Drawn&) const = default;
};
Drawn drawn(const Mesh& mesh, std::size_t triangle) {
    Drawn d{{}, mesh.material[triangle]};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = mesh.index[triangle * 3 + k];
        const Vec3 &p = mesh.position[v], &n = mesh.normal[v];
        d.corner[k] = {p.x, p.y, p.z, n.x, n.y, n.z};
    }
    return d;
}
std::map<std::uint32_t, Drawn> by_face(const Mesh& mesh) {
    std::map<std::uint32_t, Drawn> all;
    for (std::size_t t = 0; t < mesh.triangles(); ++t)
        all.emplace(mesh.face[t], drawn(mesh, t));
    return all;
}

Mesh ball() {
    Mesh mesh = test::empty_mesh();
    test::add_sphere(mesh, Vec3(0), 0.8F, 120, 60);
    return mesh;
}

// Triangles in any order; face t is the t-th of the file.
void shuffle(Random& random, Mesh& mesh) {
    for (std::size_t i = mesh.triangles(); i-- > 1;) {
        const auto j = static_cast<std::size_t>(random.whole(0, static_cast<int>(i)));
        for (std::size_t k = 0; k < 3; ++k)
            std::swap(mesh.index[i * 3 + k], mesh.index[j * 3 + k]);
        std::swap(mesh.material[i], mesh.material[j]);
    }
    std::iota(mesh.face.begin(), mesh.face.end(), 0U);
}

double mean_radius(const Mesh& mesh) {
    Jobs jobs(1);
    const Clusters all = find_clusters(jobs, mesh);
    double sum = 0;
    for (const Cluster& c : all.cluster)
        sum += c.radius;
    return sum / static_cast<double>(all.cluster.size());
}

TEST(PlaceOrder, PutsNeighboursTogetherAndChangesNothingElse) {
    Random random(91);
    Mesh mesh = ball();
    for (std::size_t t = 0; t < mesh.triangles(); ++t)
        mesh.material[t] = static_cast<std::int32_t>(t % 3) - 1;
    shuffle(random, mesh);
    const auto v = static_cast<std::uint32_t>(mesh.position.size());
    test::add_vertex(mesh, Vec3(0.9F, 0, 0)); // of a line and a point alone
    test::add_line(mesh, 0, v);
    test::add_point(mesh, v);
    Mesh placed = mesh, by_many = mesh;
    Jobs one(1), three(3);
    order_by_place(one, placed);
    order_by_place(three, by_many);
    EXPECT_EQ(placed.index, by_many.index);
    EXPECT_EQ(placed.face, by_many.face);
    EXPECT_NE(placed.face, mesh.face);
    EXPECT_EQ(by_face(placed), by_face(mesh));
    EXPECT_EQ(by_face(placed).size(), mesh.triangles());
    EXPECT_LT(mean_radius(placed), mean_radius(mesh) / 5);
    ASSERT_EQ(placed.position.size(), mesh.position.size());
    for (std::size_t k = 0; k < 2; ++k)
        EXPECT_EQ(placed.position[placed.line_index[k]], mesh.position[mesh.line_index[k]]);
    EXPECT_EQ(placed.position[placed.point_index[0]], mesh.position[v]);
    // Vertices as triangles use them first.
    std::uint32_t next = 0;
    for (const std::uint32_t vertex : placed.index) {
        EXPECT_LE(vertex, next);
        next = std::max(next, vertex + 1);
    }
}

TEST(PlaceOrder, LeavesWhatLiesTogetherOrIsSmall) {
    Random random(92);
    Jobs jobs(2);
    Mesh mesh = ball(), placed = mesh;
    order_by_place(jobs, placed);
    EXPECT_EQ(placed.index, mesh.index); // as it was made: row by row
    Mesh few = test::empty_mesh();
    test::add_sphere(few, Vec3(0), 0.8F, 20, 10);
    shuffle(random, few);
    placed = few;
    order_by_place(jobs, placed);
    EXPECT_EQ(placed.index, few.index);
    placed = test::empty_mesh();
    order_by_place(jobs, placed);
    EXPECT_EQ(placed.triangles(), 0U);
}

// Which of two that stand in one place is seen does not change.
TEST(PlaceOrder, KeepsTheFirstOfThoseInOnePlaceFirst) {
    Random random(93);
    Jobs jobs(2);
    Mesh mesh = ball();
    const std::vector<std::uint32_t> once = mesh.index;
    mesh.index.insert(mesh.index.end(), once.begin(), once.end());
    mesh.material.resize(mesh.triangles(), -1);
    mesh.face.resize(mesh.triangles());
    shuffle(random, mesh);
    order_by_place(jobs, mesh);
    std::map<Drawn, std::uint32_t> last;
    int twice = 0;
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        const auto [at, first] = last.emplace(drawn(mesh, t), mesh.face[t]);
        if (first) continue;
        EXPECT_LT(at->second, mesh.face[t]);
        ++twice;
    }
    EXPECT_EQ(twice, static_cast<int>(mesh.triangles() / 2));
}

// Thin triangles stand in runs of their own.
TEST(PlaceOrder, PutsThinOnesApart) {
    Random random(94);
    Jobs jobs(2);
    Mesh mesh = ball();
    const std::size_t stout = mesh.triangles();
    for (std::size_t t = 0; t < stout; t += 10) { // one in ten again, as a sliver at its edge
        const Vec3 a = mesh.position[mesh.index[t * 3]], b = mesh.position[mesh.index[t * 3 + 1]];
        const std::uint32_t first = test::add_vertex(mesh, a);
        test::add_vertex(mesh, b);
        test::add_vertex(mesh, (a + b) * 0.50001F);
        test::add_triangle(mesh, first, first + 1, first + 2, 7);
    }
    shuffle(random, mesh);
    order_by_place(jobs, mesh);
    const std::size_t runs = mesh.triangles() / Clusters::kTriangles;
    std::size_t with_thin = 0;
    for (std::size_t run = 0; run < runs; ++run) {
        const auto first =
            mesh.material.begin() + static_cast<std::ptrdiff_t>(run * Clusters::kTriangles);
        with_thin += std::count(first, first + Clusters::kTriangles, 7) > 0 ? 1U : 0U;
    }
    EXPECT_LT(with_thin, runs / 3); // in any order nearly all have one
}

} // namespace
} // namespace scanout::geom
