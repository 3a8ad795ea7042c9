// Clusters that cannot widen a light's view are not asked, and its view is the same to the bit.
#include "frame/view/light_view.h"
#include "geom/clusters.h"
#include "support/lights.h"
#include "support/meshes.h"
#include "support/random.h"

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

} // namespace
} // namespace scanout::frame
