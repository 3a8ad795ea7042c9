// Clusters that are passed over change no bit of a picture, and are many where much is out of
// sight.
#include "raster/culling/cluster_cull.h"
#include "raster/exact.h"
#include "support/meshes.h"

#include <algorithm>
#include <cmath>

namespace scanout::raster::test {
namespace {

// Round things of triangles from a fraction of a pixel to many, in no order of size; needles, whose
// winding the grid may turn over.
geom::Mesh things(Random& random) {
    geom::Mesh mesh = scanout::test::empty_mesh();
    for (int i = 0; i < 6; ++i) {
        const int around = 4 << random.whole(0, 4);
        scanout::test::add_sphere(mesh, Vec3(random.in_cube(1.5)),
                                  static_cast<float>(random.in(0.05, 0.6)), around,
                                  std::max(around / 2, 3));
    }
    for (Vec3& p : mesh.position)
        p = p * static_cast<float>(random.in(0.998, 1.002));
    for (int i = 0; i < 400; ++i) {
        const DVec3 at = random.in_cube(1), along = random.in_cube(0.1);
        add_triangle(mesh,
                     {Vec3(at), Vec3(at + along), Vec3(at + along * 0.5 + random.in_cube(1e-4))});
    }
    return mesh;
}

DMat3 turned(Random& random, double mirror) {
    DVec3 a = random.in_cube(1), b = random.in_cube(1);
    a = a / std::sqrt(dot3(a, a));
    b = b - a * dot3(a, b);
    b = b / std::sqrt(dot3(b, b));
    const double size = random.in(0.5, 2);
    return DMat3(a * size, b * (size * random.in(0.7, 1.3)), cross3(a, b) * (size * mirror));
}

// From outside, from within, from far away, and of a small part.
scene::View any_view(Random& random, int number) {
    const double extent = number % 3 == 0 ? 0.1 : 0.6;
    const double distance = number % 5 == 0 ? random.in(0, 1) : std::exp(random.in(0, 4));
    scene::View view = eye_view(extent, extent * 0.75, distance, 1e-3);
    view.mirrored = number % 4 == 1;
    view.linear = turned(random, view.mirrored ? -1 : 1);
    if (number % 7 == 3) {
        view.projection = scene::Projection::orthographic;
        view.half_width = extent * distance;
        view.half_height = extent * distance * 0.75;
        view.depth_origin = -distance - 8;
        view.depth_scale = 1.0 / 16;
    }
    return view;
}

std::vector<std::uint8_t> hidden_by(const ClusterCull& cull, const geom::Clusters& clusters) {
    std::vector<std::uint8_t> culled(clusters.cluster.size());
    cull.find_culled(clusters.cluster, culled.data());
    return culled;
}

TEST(ClusterCull, ChangesNoBit) {
    Random random(82);
    Jobs jobs(1);
    std::size_t culled = 0, back_facing = 0, all = 0;
    for (int round = 0; round < 400; ++round) {
        geom::Mesh mesh = things(random);
        const scene::View view = any_view(random, round);
        const Facing keep = static_cast<Facing>(round % 3);
        const int samples = round % 2 == 0 ? 1 : 4;
        const Planes without = draw_planes(jobs, mesh, view, 80, 60, samples, keep);
        mesh.clusters = geom::find_clusters(jobs, mesh);
        const Planes with = draw_planes(jobs, mesh, view, 80, 60, samples, keep);
        EXPECT_TRUE(with == without) << round;
        const ScreenTransform transform(view, 80, 60);
        const auto by_all = hidden_by(ClusterCull(transform, keep), mesh.clusters);
        const auto beside = hidden_by(ClusterCull(transform, Facing::any), mesh.clusters);
        for (std::size_t c = 0; c < by_all.size(); ++c) {
            culled += by_all[c];
            back_facing += by_all[c] != 0 && beside[c] == 0 ? 1 : 0;
            ++all;
        }
    }
    record("culled", static_cast<double>(culled) / static_cast<double>(all));
    EXPECT_GT(culled, all / 4);
    EXPECT_GT(back_facing, all / 50);
}

// Vertices of a cluster that has bounds stand on the screen, within them.
TEST(ClusterCull, BoundsHoldEveryVertex) {
    Random random(84);
    Jobs jobs(1);
    std::size_t bounded = 0, all = 0, near = 0;
    for (int round = 0; round < 300; ++round) {
        const geom::Mesh mesh = things(random);
        const geom::Clusters clusters = geom::find_clusters(jobs, mesh);
        const ScreenTransform transform(any_view(random, round), 80, 60);
        const ClusterCull cull(transform, Facing::any);
        for (std::size_t c = 0; c < clusters.cluster.size(); ++c) {
            const auto bounds = cull.bounds(clusters.cluster[c]);
            ++all;
            if (!bounds) continue;
            ++bounded;
            double nearest = 0;
            for (std::size_t k = c * geom::Clusters::kTriangles * 3;
                 k < std::min((c + 1) * geom::Clusters::kTriangles * 3, mesh.index.size()); ++k) {
                const ScreenVertex v = transform.transform(mesh.position[mesh.index[k]]);
                ASSERT_TRUE(v.on_screen()) << round << ' ' << c;
                const double x = std::clamp(v.x / double{kSubpixel}, 0.0, 80.0),
                             y = std::clamp(v.y / double{kSubpixel}, 0.0, 60.0);
                EXPECT_GE(x, bounds->pixels.x0) << round << ' ' << c;
                EXPECT_LE(x, bounds->pixels.x1) << round << ' ' << c;
                EXPECT_GE(y, bounds->pixels.y0) << round << ' ' << c;
                EXPECT_LE(y, bounds->pixels.y1) << round << ' ' << c;
                nearest = std::max(nearest, v.depth);
            }
            EXPECT_LE(nearest, double{bounds->nearest}) << round << ' ' << c;
            near += nearest > double{bounds->nearest} * 0.8 ? 1 : 0;
        }
    }
    EXPECT_GT(bounded, all / 2);
    EXPECT_GT(near, bounded / 2); // and are no wider than they have to be
}

// The grid turns needles over, whichever way they face.
TEST(ClusterCull, KeepsWhatIsThinnerThanTheGrid) {
    Random random(83);
    Jobs jobs(1);
    int shown = 0;
    for (int round = 0; round < 200; ++round) {
        geom::Mesh mesh = scanout::test::empty_mesh();
        for (int i = 0; i < 64; ++i) { // all face away
            const double x = random.in(-0.9, 0.9), y = random.in(-0.9, 0.9);
            const double width = random.in(0.2, 0.6), thin = std::ldexp(1.0, -random.whole(8, 20));
            const double lean = random.in(-0.3, 0.3);
            add_triangle(mesh,
                         {Vec3(DVec3(x, y, 0)), Vec3(DVec3(x + width / 2, y + lean / 2 + thin, 0)),
                          Vec3(DVec3(x + width, y + lean, 0))});
        }
        const scene::View view = eye_view(0.02, 0.02, 50); // as if from afar
        const Planes without = draw_planes(jobs, mesh, view, 64, 64, 16, Facing::front);
        mesh.clusters = geom::find_clusters(jobs, mesh);
        EXPECT_TRUE(draw_planes(jobs, mesh, view, 64, 64, 16, Facing::front) == without) << round;
        shown += std::any_of(without.ids.begin(), without.ids.end(),
                             [](std::uint32_t id) { return id != kNoPrimitive; })
                     ? 1
                     : 0;
    }
    EXPECT_GT(shown, 20);
}

TEST(ClusterCull, LeavesOutTheBackOfABall) {
    Jobs jobs(1);
    geom::Mesh mesh = scanout::test::empty_mesh();
    scanout::test::add_sphere(mesh, Vec3(0), 1, 256, 128);
    const geom::Clusters clusters = geom::find_clusters(jobs, mesh);
    const ScreenTransform transform(eye_view(0.4, 0.4, 3), 1024, 1024);
    const auto culled = [&](Facing keep) {
        const auto of = hidden_by(ClusterCull(transform, keep), clusters);
        return std::count(of.begin(), of.end(), 1);
    };
    const auto all = static_cast<std::ptrdiff_t>(clusters.cluster.size());
    EXPECT_EQ(culled(Facing::any), 0);
    EXPECT_GT(culled(Facing::front), all * 3 / 10);
    EXPECT_GT(culled(Facing::back), all / 10);
}

} // namespace
} // namespace scanout::raster::test
