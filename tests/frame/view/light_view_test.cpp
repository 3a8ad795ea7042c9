// Clusters that cannot widen a light's view are not asked, and its view is the same to the bit;
// what a view holds.
#include "frame/view/light_view.h"
#include "geom/clusters.h"
#include "support/lights.h"
#include "support/meshes.h"
#include "support/random.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace scanout::frame {
namespace {

using scanout::test::Random;

TEST(LightView, IsTheSameToTheBitWithClustersAndWithout) {
    Random random(91);
    Jobs jobs(1);
    int single = 0;
    for (int round = 0; round < 300; ++round) {
        geom::Mesh mesh = scanout::test::empty_mesh();
        for (int i = 0; i < 4; ++i)
            scanout::test::add_sphere(mesh, Vec3(random.in_cube(0.7)),
                                      static_cast<float>(random.in(0.01, 0.4)), 16, 12);
        scene::View view;
        for (int c = 0; c < 3; ++c)
            view.linear[c] = random.in_cube(1);
        view.translation = {0, 0, -random.in(1, 5)};
        scene::ViewLight light{};
        light.kind = static_cast<scene::LightKind>(static_cast<int>(scene::LightKind::directional) +
                                                   round % 3);
        light.towards = Vec3(random.in_cube(1));
        light.axis = Vec3(random.in_cube(1));
        light.position = Vec3(random.in_cube(round % 2 == 0 ? 30 : 2));
        light.cos_outer = 0.1F;
        std::vector<LightView> without, with;
        light_views(light, mesh, view, 256, 4, without);
        mesh.clusters = geom::find_clusters(jobs, mesh);
        light_views(light, mesh, view, 256, 4, with);
        ASSERT_EQ(with.size(), without.size());
        single += with.size() == 1 ? 1 : 0;
        for (std::size_t i = 0; i < with.size(); ++i) {
            EXPECT_EQ(with[i].texels_x, without[i].texels_x) << round;
            EXPECT_EQ(with[i].texels_y, without[i].texels_y) << round;
            EXPECT_EQ(with[i].translation, without[i].translation) << round;
            EXPECT_EQ(with[i].view.depth_scale, without[i].view.depth_scale) << round;
            EXPECT_EQ(with[i].view.translation, without[i].view.translation) << round;
        }
    }
    EXPECT_GT(single, 150);
}

// A filter asks up to a margin beside a caster: all casters lie within the map's inner part, where
// float rounding of the map's own vertices and of receivers still leaves them, and behind its near
// plane. Views are wider by 2^-10 for that.
TEST(LightView, HoldsEveryCasterAndLeavesTheMarginFree) {
    Random random(92);
    constexpr int kSize = 256, kMargin = 4;
    int single = 0;
    double fullest = 0;
    for (int round = 0; round < 400; ++round) {
        geom::Mesh mesh = scanout::test::empty_mesh();
        for (int i = 0; i < 3; ++i)
            scanout::test::add_sphere(mesh, Vec3(random.in_cube(0.7)),
                                      static_cast<float>(random.in(0.01, 0.4)), 8, 6);
        scene::View view;
        for (int c = 0; c < 3; ++c)
            view.linear[c] = random.in_cube(1);
        view.translation = {0, 0, -random.in(1, 5)};
        scene::ViewLight light{};
        light.kind = static_cast<scene::LightKind>(static_cast<int>(scene::LightKind::directional) +
                                                   round % 3);
        light.towards = Vec3(random.in_cube(1));
        light.axis = Vec3(random.in_cube(1));
        light.position = Vec3(random.in_cube(30));
        light.cos_outer = -1; // a spot's cone holds all
        std::vector<LightView> maps;
        light_views(light, mesh, view, kSize, kMargin, maps);
        if (maps.size() != 1) continue;
        ++single;
        const LightView& map = maps[0];
        const bool parallel = map.view.projection == scene::Projection::orthographic;
        for (const Vec3& vertex : mesh.position) {
            const DVec3 p =
                map.rotation * (view.linear * DVec3(vertex) + view.translation) + map.translation;
            const double by = parallel ? 1 : -1 / p.z;
            const double x = std::abs(p.x * by * map.texels_x),
                         y = std::abs(p.y * by * map.texels_y);
            const double room = map.half - kMargin;
            ASSERT_LE(std::max(x, y), room * (1 - 0x1p-11)) << round;
            fullest = std::max(fullest, std::max(x, y) / room);
            if (!parallel) {
                ASSERT_GT(-p.z, map.view.near_distance) << round;
            }
        }
    }
    EXPECT_GT(fullest, 1 - 0x1p-9); // and none is much wider than it must be
    EXPECT_GT(single, 100);
}

} // namespace
} // namespace scanout::frame
