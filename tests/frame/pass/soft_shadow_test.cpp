// Shadows of lights with a size: how soft they are.
#include "frame/shadow_shares.h"

#include <array>
#include <map>

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

// A rough ball under a plate that hides all of the light. Many of its faces the light would graze,
// and what is forgiven there grows with the distance, up to the plate (HARD-CASES 76).
TEST(Shadow, OfALightWithASizeHasNoBrightSpecksInItsUmbra) {
    Shot s = shot("umbra", 192, 144);
    s.scene.materials = {plain(Vec3(0.8F))};
    geom::Mesh& mesh = s.scene.mesh;
    add_sphere(mesh, Vec3(0), 0.5F, 60, 45);
    Random random(3);
    std::map<std::array<float, 3>, float> height;
    for (Vec3& p : mesh.position) {
        const auto [at, added] = height.try_emplace({p.x, p.y, p.z}, 0.0F);
        if (added) at->second = static_cast<float>(random.in(0.96, 1.04));
        p = p * at->second;
    }
    add_quad(mesh, {{{-1, 0.75F, -1}, {-1, 0.75F, 1}, {1, 0.75F, 1}, {1, 0.75F, -1}}}, {0, 1, 0},
             0);
    mesh.uv.clear();
    s.camera.eye = DVec3(0, 0.3, 3);
    s.camera.target = DVec3(0, 0.1, 0);
    s.camera.fov_degrees = 25;
    s.options.lights = {lamp(scene::LightKind::directional)};
    for (const DVec3& towards : {DVec3(0, 1, 0.1), DVec3(0.4, 1, 0.3), DVec3(-0.2, 1, 0)}) {
        s.options.lights[0].towards = towards;
        for (const double size : {2, 4}) {
            s.options.lights[0].size = size;
            int asked = 0, bright = 0;
            for (const double share : shares(s, "map_soft")) {
                asked += share >= 0 ? 1 : 0;
                bright += share > 0.02 ? 1 : 0;
            }
            EXPECT_GT(asked, 3000);
            EXPECT_LE(bright, asked / 500) << size << ' ' << towards.x << ' ' << towards.z;
        }
    }
}

} // namespace
} // namespace scanout::test
