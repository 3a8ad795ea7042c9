#include "geom/clusters.h"
#include "geom/mesh.h"
#include "support/meshes.h"
#include "support/random.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace scanout::geom {
namespace {

using test::Random;

// A ball with dents, and triangles anywhere, slivers and without area among them.
Mesh dented(Random& random, int loose) {
    Mesh mesh = test::empty_mesh();
    test::add_sphere(mesh, Vec3(0.2F, -0.1F, 0), 0.6F, 40, 30);
    for (Vec3& p : mesh.position)
        p = p * static_cast<float>(random.in(0.98, 1.02));
    for (int i = 0; i < loose; ++i) {
        std::uint32_t v[3];
        for (std::uint32_t& k : v)
            k = static_cast<std::uint32_t>(
                random.whole(0, static_cast<int>(mesh.position.size()) - 1));
        test::add_triangle(mesh, v[0], v[1], i % 4 == 0 ? v[1] : v[2]);
    }
    return mesh;
}

double length(const DVec3& v) {
    return std::sqrt(dot3(v, v));
}

TEST(Clusters, HoldTheirTrianglesWithinTheirBounds) {
    Random random(81);
    Jobs jobs(3);
    int narrow = 0;
    for (int round = 0; round < 20; ++round) {
        const Mesh mesh = dented(random, round % 3 * 50 + round);
        const Clusters all = find_clusters(jobs, mesh);
        ASSERT_EQ(all.cluster.size(),
                  (mesh.triangles() + Clusters::kTriangles - 1) / Clusters::kTriangles);
        ASSERT_EQ(all.group.size(), (all.cluster.size() + Clusters::kGroup - 1) / Clusters::kGroup);
        for (std::size_t c = 0; c < all.cluster.size(); ++c) {
            const Sphere& group = all.group[c / Clusters::kGroup];
            EXPECT_LE(length(all.cluster[c].centre - group.centre) + all.cluster[c].radius,
                      group.radius * (1 + 1e-15));
            EXPECT_LE(group.radius, 4); // of meshes that lie within 1 of the middle
        }
        for (std::size_t t = 0; t < mesh.triangles(); ++t) {
            const std::size_t number = t / Clusters::kTriangles;
            const Cluster& c = all.cluster[number];
            const auto groups = all.vertex_groups_of(number);
            DVec3 p[3];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t vertex = mesh.index[t * 3 + k];
                p[k] = DVec3(mesh.position[vertex]);
                EXPECT_LE(length(p[k] - c.centre), c.radius * (1 + 1e-9));
                EXPECT_NE(
                    std::find(groups.begin(), groups.end(), vertex / Clusters::kGroupVertices),
                    groups.end());
            }
            const DVec3 n = cross3(p[1] - p[0], p[2] - p[0]);
            const double longest =
                std::max({length(p[1] - p[0]), length(p[2] - p[1]), length(p[0] - p[2])});
            EXPECT_LE(c.thinnest * longest, length(n) * (1 + 1e-9));
            if (c.spread > 1 || length(n) == 0) continue;
            ++narrow;
            const double cosine = dot3(n, c.axis) / length(n);
            EXPECT_GE(cosine, std::sqrt(1 - c.spread * c.spread) - 1e-9);
        }
    }
    EXPECT_GT(narrow, 1000);
    EXPECT_TRUE(find_clusters(jobs, test::empty_mesh()).empty());
}

} // namespace
} // namespace scanout::geom
