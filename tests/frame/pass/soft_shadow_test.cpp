// Shadows of lights with a size: how soft they are.
#include "frame/shadow_shares.h"

namespace scanout::test {
namespace {

// Pixels that are neither dark nor bright.
int penumbra(double size, double height, int map_size = 512) {
    Shot s = shot("penumbra", 96, 96);
    s.scene.materials = {plain(Vec3(0.8F))};
    add_square(s.scene.mesh, 1, 0, 0);
    add_square(s.scene.mesh, 0.3F, static_cast<float>(height), 0);
    s.scene.mesh.uv.clear();
    s.camera.projection = scene::Projection::orthographic;
    s.camera.azimuth_degrees = 60;
    s.options.lights = {lamp(scene::LightKind::directional)};
    s.options.lights[0].towards = {-0.5, 0, 1};
    s.options.lights[0].size = size;
    s.options.shadow_size = map_size;
    int partly = 0;
    for (const double share : shares(s, "map_soft"))
        partly += share > 0.02 && share < 0.98 ? 1 : 0;
    return partly;
}

TEST(Shadow, IsSofterTheLargerTheLightAndTheFartherItFalls) {
    EXPECT_GT(penumbra(2, 0.4), penumbra(0, 0.4));
    EXPECT_GT(penumbra(4, 0.4), penumbra(2, 0.4) * 3 / 2);
    EXPECT_GT(penumbra(4, 0.8), penumbra(4, 0.4) * 3 / 2);
}

TEST(Shadow, IsAsSoftInAFineMapAsInACoarseOne) {
    for (const double size : {4, 10}) {
        const int coarse = penumbra(size, 0.8);
        EXPECT_GT(coarse, 200);
        for (const int map_size : {1024, 2048, 4096})
            EXPECT_NEAR(penumbra(size, 0.8, map_size), coarse, 0.12 * coarse)
                << size << ' ' << map_size;
    }
}

} // namespace
} // namespace scanout::test
