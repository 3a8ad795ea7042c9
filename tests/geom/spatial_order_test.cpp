#include "geom/spatial_order.h"
#include "support/meshes.h"
#include "support/random.h"

#include <algorithm>
#include <array>
#include <cmath>
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
Mesh ball() {
    Mesh mesh = test::empty_mesh();
    test::add_sphere(mesh, Vec3(0), 0.8F, 120, 60);
    mesh.uv.clear(); // vertices are added that have none
    return mesh;
}

// Triangles in any order.
void shuffle(Random& random, Mesh& mesh) {
    for (std::size_t i = mesh.triangles(); i-- > 1;) {
        const auto j = static_cast<std::size_t>(random.whole(0, static_cast<int>(i)));
        for (std::size_t k = 0; k < 3; ++k)
            std::swap(mesh.index[i * 3 + k], mesh.index[j * 3 + k]);
        std::swap(mesh.material[i], mesh.material[j]);
    }
}

std::vector<std::uint32_t> order_of(Jobs& jobs, const Mesh& mesh) {
    std::vector<std::uint32_t> order;
    EXPECT_TRUE(spatial_order(jobs, mesh, order, [](double) { return true; }));
    return order;
}

double mean_radius(const Clusters& all) {
    double sum = 0;
    for (const Cluster& c : all.cluster)
        sum += c.radius;
    return sum / static_cast<double>(all.cluster.size());
}

std::vector<std::uint32_t> sorted(std::vector<std::uint32_t> numbers) {
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}
std::vector<std::uint32_t> in_file_order(const Mesh& mesh) {
    std::vector<std::uint32_t> all(mesh.triangles());
    std::iota(all.begin(), all.end(), 0U);
    return all;
}

TEST(SpatialOrder, PutsNeighboursTogetherAndChangesNothingThatIsDrawn) {
    Random random(91);
    Mesh mesh = ball();
    for (std::size_t t = 0; t < mesh.triangles(); ++t)
        mesh.material[t] = static_cast<std::int32_t>(t % 3) - 1;
    shuffle(random, mesh);
    const auto v = static_cast<std::uint32_t>(mesh.position.size());
    test::add_vertex(mesh, Vec3(0.9F, 0, 0)); // of a point and of a line
    test::add_point(mesh, v);
    test::add_line(mesh, 5, v);
    Mesh placed = mesh;
    Jobs jobs(2);
    const std::vector<std::uint32_t> order = order_of(jobs, placed);
    EXPECT_EQ(sorted(order), in_file_order(mesh));
    EXPECT_NE(order, in_file_order(mesh));
    order_vertices(jobs, placed, order);
    placed.clusters = find_clusters(jobs, placed, order);
    ASSERT_EQ(placed.position.size(), mesh.position.size());
    ASSERT_EQ(placed.triangles(), mesh.triangles());
    for (std::size_t t = 0; t < mesh.triangles(); ++t)
        ASSERT_TRUE(drawn(placed, t) == drawn(mesh, t)) << t;
    EXPECT_EQ(placed.position[placed.point_index[0]], mesh.position[v]);
    EXPECT_EQ(placed.position[placed.line_index[0]], mesh.position[5]);
    EXPECT_EQ(placed.position[placed.line_index[1]], mesh.position[v]);
    // Clusters have them in spatial order, and vertices are in the order of first use.
    EXPECT_EQ(placed.clusters.triangle, order);
    EXPECT_LT(mean_radius(placed.clusters), mean_radius(find_clusters(jobs, mesh)) / 5);
    const auto in_spatial_order = placed.index_in_spatial_order();
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < in_spatial_order.size(); ++i) {
        ASSERT_EQ(in_spatial_order[i], placed.index[std::size_t{order[i / 3]} * 3 + i % 3]);
        EXPECT_LE(in_spatial_order[i], next);
        next = std::max(next, in_spatial_order[i] + 1);
    }
}

// Large enough that each worker has parts, and that vertices carry all that they can.
TEST(SpatialOrder, DoesNotDependOnThreads) {
    Random random(95);
    Mesh mesh = test::empty_mesh();
    test::add_sphere(mesh, Vec3(0), 0.8F, 500, 250);
    mesh.uv.clear();
    for (const Vec3& p : mesh.position)
        mesh.uv.push_back({p.x, p.y});
    mesh.colour = mesh.position;
    shuffle(random, mesh);
    Mesh one = mesh, many = mesh;
    Jobs alone(1), three(3);
    const std::vector<std::uint32_t> order = order_of(alone, one);
    EXPECT_GT(mesh.triangles(), 200000U);
    EXPECT_EQ(order.size(), mesh.triangles());
    EXPECT_EQ(order_of(three, many), order);
    order_vertices(alone, one, order);
    order_vertices(three, many, order);
    EXPECT_TRUE(one.index == many.index && one.position == many.position &&
                one.normal == many.normal && one.uv == many.uv && one.colour == many.colour);
    EXPECT_NE(one.index, mesh.index);
    for (std::size_t v = 0; v < one.position.size(); ++v) {
        const Vec3& p = one.position[v];
        ASSERT_TRUE(one.colour[v] == p && one.uv[v].x == p.x && one.uv[v].y == p.y) << v;
    }
    EXPECT_EQ(find_clusters(alone, one, order).index, find_clusters(three, many, order).index);
}

bool is_left(const Mesh& mesh) {
    Jobs jobs(2);
    return order_of(jobs, mesh).empty();
}
Mesh first_of(Mesh mesh, std::size_t triangles) {
    mesh.index.resize(triangles * 3);
    mesh.material.resize(triangles);
    mesh.face.resize(triangles);
    return mesh;
}

TEST(SpatialOrder, LeavesWhatLiesTogetherOrWouldNotOrIsSmall) {
    Random random(92);
    EXPECT_TRUE(is_left(ball())); // as it was made: row by row
    EXPECT_TRUE(is_left(test::empty_mesh()));
    Mesh mesh = ball();
    shuffle(random, mesh);
    EXPECT_TRUE(is_left(first_of(mesh, 1023)));
    EXPECT_FALSE(is_left(first_of(mesh, 1024)));
    Mesh needles = test::empty_mesh(); // all through the middle, each as long as the whole
    for (int i = 0; i < 2000; ++i) {
        const Vec3 end(random.in_cube(0.5));
        const auto v = test::add_vertex(needles, end);
        test::add_vertex(needles, -end);
        test::add_vertex(needles, end * 0.999F + Vec3(0, 0, 0.001F));
        test::add_triangle(needles, v, v + 1, v + 2);
    }
    EXPECT_TRUE(is_left(needles));
}

TEST(SpatialOrder, SaysHowFarItIsAndStopsWhenTold) {
    Random random(96);
    Mesh mesh = test::empty_mesh();
    test::add_sphere(mesh, Vec3(0), 0.8F, 1000, 500); // thirty parts
    shuffle(random, mesh);
    Jobs jobs(2);
    std::vector<std::uint32_t> order;
    double last = 0;
    int calls = 0;
    EXPECT_TRUE(spatial_order(jobs, mesh, order, [&](double share) {
        EXPECT_TRUE(share > last && share < 1) << share;
        last = share;
        ++calls;
        return true;
    }));
    EXPECT_GE(calls, 3);
    for (int stop = 1; stop <= calls; ++stop) {
        int left = stop;
        EXPECT_FALSE(spatial_order(jobs, mesh, order, [&](double) { return --left > 0; }));
        EXPECT_EQ(left, 0);
    }
}

// Thin triangles stand in runs of their own.
TEST(SpatialOrder, PutsThinOnesApart) {
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
    const std::vector<std::uint32_t> order = order_of(jobs, mesh);
    const std::size_t runs = mesh.triangles() / Clusters::kTriangles;
    ASSERT_EQ(order.size(), mesh.triangles());
    std::size_t with_thin = 0;
    for (std::size_t run = 0; run < runs; ++run) {
        const auto first = order.begin() + static_cast<std::ptrdiff_t>(run * Clusters::kTriangles);
        with_thin += std::any_of(first, first + Clusters::kTriangles,
                                 [&](std::uint32_t t) { return mesh.material[t] == 7; })
                         ? 1U
                         : 0U;
    }
    EXPECT_LT(with_thin, runs / 3); // in any order nearly all have one
}

} // namespace
} // namespace scanout::geom
