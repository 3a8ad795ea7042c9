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
    mesh.uv.clear(); // vertices are added that have none
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
    test::add_vertex(mesh, Vec3(0.9F, 0, 0)); // of a point alone
    test::add_point(mesh, v);
    Mesh placed = mesh;
    Jobs jobs(2);
    order_by_place(jobs, placed);
    EXPECT_NE(placed.face, mesh.face);
    EXPECT_EQ(by_face(placed), by_face(mesh));
    EXPECT_EQ(by_face(placed).size(), mesh.triangles());
    EXPECT_LT(mean_radius(placed), mean_radius(mesh) / 5);
    ASSERT_EQ(placed.position.size(), mesh.position.size());
    EXPECT_EQ(placed.position[placed.point_index[0]], mesh.position[v]);
    // Vertices as triangles use them first.
    std::uint32_t next = 0;
    for (const std::uint32_t vertex : placed.index) {
        EXPECT_LE(vertex, next);
        next = std::max(next, vertex + 1);
    }
}

// Large enough that each worker has parts, and that vertices carry all that they can.
TEST(PlaceOrder, DoesNotDependOnThreads) {
    Random random(95);
    Mesh mesh = test::empty_mesh();
    test::add_sphere(mesh, Vec3(0), 0.8F, 500, 250);
    mesh.uv.clear();
    for (const Vec3& p : mesh.position)
        mesh.uv.push_back({p.x, p.y});
    mesh.colour = mesh.position;
    for (std::size_t t = 0; t < mesh.triangles(); ++t)
        mesh.material[t] = static_cast<std::int32_t>(t % 3) - 1;
    shuffle(random, mesh);
    Mesh one = mesh, many = mesh;
    Jobs alone(1), three(3);
    order_by_place(alone, one);
    order_by_place(three, many);
    EXPECT_GT(mesh.triangles(), 200000U);
    EXPECT_NE(one.face, mesh.face);
    EXPECT_TRUE(one.index == many.index && one.face == many.face && one.material == many.material &&
                one.position == many.position && one.normal == many.normal && one.uv == many.uv &&
                one.colour == many.colour);
    for (std::size_t v = 0; v < one.position.size(); ++v) {
        const Vec3& p = one.position[v];
        ASSERT_TRUE(one.colour[v] == p && one.uv[v].x == p.x && one.uv[v].y == p.y) << v;
    }
}

void expect_left(Mesh mesh) {
    const Mesh before = mesh;
    Jobs jobs(2);
    order_by_place(jobs, mesh);
    EXPECT_EQ(mesh.index, before.index);
    EXPECT_EQ(mesh.face, before.face);
}
Mesh first_of(Mesh mesh, std::size_t triangles) {
    mesh.index.resize(triangles * 3);
    mesh.material.resize(triangles);
    mesh.face.resize(triangles);
    return mesh;
}

TEST(PlaceOrder, LeavesWhatLiesTogetherOrWouldNotOrIsSmallOrHasLines) {
    Random random(92);
    expect_left(ball()); // as it was made: row by row
    expect_left(test::empty_mesh());
    Mesh mesh = ball();
    shuffle(random, mesh);
    expect_left(first_of(mesh, 1023));
    Jobs jobs(2);
    const Mesh enough = first_of(mesh, 1024);
    Mesh placed = enough;
    order_by_place(jobs, placed);
    EXPECT_NE(placed.face, enough.face);
    test::add_line(mesh, 0, 1);
    expect_left(mesh);
    Mesh needles = test::empty_mesh(); // all through the middle, each as long as the whole
    for (int i = 0; i < 2000; ++i) {
        const Vec3 end(random.in_cube(0.5));
        const auto v = test::add_vertex(needles, end);
        test::add_vertex(needles, -end);
        test::add_vertex(needles, end * 0.999F + Vec3(0, 0, 0.001F));
        test::add_triangle(needles, v, v + 1, v + 2);
    }
    expect_left(needles);
}

// Which of two that stand in one place is seen does not change.
TEST(PlaceOrder, KeepsTheFirstOfThoseInOnePlaceFirst) {
    Random random(93);
    Jobs jobs(2);
    Mesh mesh = ball();
    const std::vector<std::uint32_t> once = mesh.index;
    // A third of them again from another corner on.
    mesh.index.insert(mesh.index.end(), once.begin(), once.end());
    for (std::size_t i = once.size(); i < mesh.index.size(); i += 9)
        std::rotate(mesh.index.begin() + static_cast<std::ptrdiff_t>(i),
                    mesh.index.begin() + static_cast<std::ptrdiff_t>(i + 1),
                    mesh.index.begin() + static_cast<std::ptrdiff_t>(i + 3));
    mesh.material.resize(mesh.triangles(), -1);
    mesh.face.resize(mesh.triangles());
    shuffle(random, mesh);
    order_by_place(jobs, mesh);
    std::map<Drawn, std::uint32_t> last;
    int twice = 0;
    for (std::size_t t = 0; t < mesh.triangles(); ++t) {
        Drawn d = drawn(mesh, t);
        std::sort(d.corner.begin(), d.corner.end());
        const auto [at, first] = last.emplace(d, mesh.face[t]);
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
