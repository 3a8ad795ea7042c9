// Clusters that are deferred because they were occluded change no bit of a picture, whatever was
// visible before; what a frame occludes costs no triangle from the next but one on, and visible
// clusters are rarely queried.
#include "raster/culling/occlusion.h"
#include "raster/exact.h"
#include "support/meshes.h"

#include <algorithm>
#include <cmath>

namespace scanout::raster::test {
namespace {

// A wall in front of balls of small triangles, some of which come through it by a little.
geom::Mesh balls_behind_a_wall(Jobs& jobs, Random& random) {
    geom::Mesh mesh = scanout::test::empty_mesh();
    constexpr double kWall = 0.9;
    for (int i = 0; i < 5; ++i) {
        const double radius = random.in(0.1, 0.5);
        DVec3 centre = random.in_cube(1);
        if (i < 3) centre.z = kWall - radius + std::exp2(random.in(-9, -4));
        scanout::test::add_sphere(mesh, Vec3(centre), static_cast<float>(radius), 96, 32);
    }
    scanout::test::add_square(mesh, static_cast<float>(random.in(0.2, 1.2)),
                              static_cast<float>(kWall));
    mesh.clusters = geom::find_clusters(jobs, mesh);
    return mesh;
}

scene::View turned(double angle, int number) {
    scene::View view = eye_view(0.4, 0.3, 3, 1e-3);
    view.linear = DMat3(DVec3(std::cos(angle), 0, -std::sin(angle)), DVec3(0, 1, 0),
                        DVec3(std::sin(angle), 0, std::cos(angle)));
    if (number % 3 == 2) {
        view.projection = scene::Projection::orthographic;
        view.half_width = 1.2;
        view.half_height = 0.9;
        view.depth_origin = -6;
        view.depth_scale = 1.0 / 6;
    }
    return view;
}

TEST(OcclusionHistory, ChangesNoBit) {
    Random random(91);
    Jobs one(1), three(3);
    std::uint64_t drawn = 0, drawn_without = 0;
    for (int round = 0; round < 12; ++round) {
        const geom::Mesh mesh = balls_behind_a_wall(one, random);
        const Facing keep = static_cast<Facing>(round % 3);
        const int samples = round % 4 == 3 ? 4 : 1, tile_size = round % 5 == 4 ? 32 : 64;
        OcclusionHistory history;
        double angle = 0;
        for (int frame = 0; frame < 60; ++frame) {
            angle = frame % 25 == 24 ? random.in(-3, 3) : angle + random.in(0, 0.02);
            const scene::View view = turned(angle, round);
            const auto draw = [&](Jobs& jobs, OcclusionHistory* from, std::uint64_t& count) {
                return draw_planes(jobs, mesh, view, 200, 150, samples, keep, tile_size, from,
                                   &count);
            };
            std::uint64_t here = 0, here_without = 0;
            const Planes without = draw(one, nullptr, here_without);
            ASSERT_TRUE(draw(frame % 2 == 0 ? one : three, &history, here) == without)
                << round << ' ' << frame;
            EXPECT_LE(here, here_without) << round << ' ' << frame;
            drawn += here;
            drawn_without += here_without;
        }
    }
    record("drawn", static_cast<double>(drawn) / static_cast<double>(drawn_without));
    EXPECT_LT(drawn, drawn_without * 95 / 100);
}

// The fraction of a mesh's clusters that is deferred in the next frame.
double share_deferred_next(OcclusionHistory& history, const geom::Mesh& mesh) {
    const std::size_t clusters = mesh.clusters.cluster.size();
    history.begin_frame(clusters);
    int deferred = 0;
    for (std::size_t c = 0; c < clusters; ++c)
        deferred += history.next_action(c) == OcclusionHistory::Action::defer ? 1 : 0;
    return deferred / static_cast<double>(clusters);
}

// No triangle that a wall occludes is drawn once all were queried; all are when the eye is
// behind it.
TEST(OcclusionHistory, OccludedClustersCostNoTriangle) {
    Jobs jobs(2);
    geom::Mesh mesh = scanout::test::empty_mesh();
    scanout::test::add_sphere(mesh, Vec3(0), 0.7F, 384, 64);
    scanout::test::add_square(mesh, 2, 1);
    mesh.clusters = geom::find_clusters(jobs, mesh);
    const auto all = mesh.triangles();
    OcclusionHistory history;
    const auto drawn = [&](double angle) {
        std::uint64_t count = 0;
        draw_planes(jobs, mesh, turned(angle, 0), 640, 480, 1, Facing::any, 64, &history, &count);
        return count;
    };
    const std::uint64_t at_first = drawn(0);
    EXPECT_GT(at_first, all * 8 / 10);
    EXPECT_EQ(drawn(0), at_first); // which queries
    EXPECT_EQ(drawn(0), 2U);
    EXPECT_GT(drawn(3.14159265358979), all * 8 / 10);
    EXPECT_LT(share_deferred_next(history, mesh), 0.1);
}

// A cluster that was queried and visible is not deferred: that would cost more.
TEST(OcclusionHistory, VisibleClustersAreNotDeferred) {
    Jobs jobs(2);
    geom::Mesh mesh = scanout::test::empty_mesh();
    scanout::test::add_sphere(mesh, Vec3(0), 0.7F, 384, 64);
    mesh.clusters = geom::find_clusters(jobs, mesh);
    OcclusionHistory history;
    for (int frame = 0; frame < 2; ++frame)
        draw_planes(jobs, mesh, turned(0, 0), 640, 480, 1, Facing::front, 64, &history, nullptr);
    EXPECT_LT(share_deferred_next(history, mesh), 0.05);
}

constexpr std::size_t kClusters = 4096;

// A frame with the clusters from `first` on in view, of which those below `end` are occluded. How
// many were queried or deferred?
std::size_t queried(OcclusionHistory& history, std::size_t first, std::size_t end) {
    history.begin_frame(kClusters);
    std::size_t count = 0;
    for (std::size_t c = first; c < kClusters; ++c) {
        if (history.next_action(c) == OcclusionHistory::Action::draw) continue;
        ++count;
        if (c >= end) history.set_visible(c);
    }
    return count;
}

TEST(OcclusionHistory, QueriesAreRareWhereNoneIsOccluded) {
    OcclusionHistory history;
    EXPECT_EQ(queried(history, 0, 0), 0U);        // the first frame may be the only one
    EXPECT_EQ(queried(history, 0, 0), kClusters); // in the second all are
    for (int frame = 0; frame < 20; ++frame)
        queried(history, 0, 0);
    EXPECT_EQ(queried(history, 0, 0), kClusters / 2048);
    // Many become occluded: they are found sooner than one by one.
    for (int frame = 0; frame < 60; ++frame)
        queried(history, 0, kClusters / 2);
    EXPECT_GE(queried(history, 0, kClusters / 2), kClusters / 2);
}

// How often they are tried goes by those in sight.
TEST(OcclusionHistory, ClustersOutOfViewHaveNoResult) {
    OcclusionHistory history;
    constexpr std::size_t kHalf = kClusters / 2;
    for (int frame = 0; frame < 60; ++frame)
        queried(history, 0, kHalf); // one half is occluded, the other is not
    for (int frame = 0; frame < 20; ++frame)
        queried(history, kHalf, 0); // the other alone is in sight
    EXPECT_EQ(queried(history, kHalf, 0), kHalf / 2048);
    for (int frame = 0; frame < 40; ++frame)
        queried(history, kHalf, kClusters); // and all of it becomes occluded
    EXPECT_EQ(queried(history, kHalf, kClusters), kHalf);
    EXPECT_GE(queried(history, 0, kClusters), kClusters); // what was occluded before still is
}

} // namespace
} // namespace scanout::raster::test
