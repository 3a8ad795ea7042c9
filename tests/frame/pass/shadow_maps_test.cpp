// What a pass of shadow maps keeps from one frame to the next.
#include "frame/pass/lights.h"
#include "frame/pass/shadow_maps.h"
#include "frame/plans.h"
#include "support/scenes.h"

#include <algorithm>

namespace scanout::frame {
namespace {

using scene::LightKind;

std::vector<std::vector<float>> maps(ShadowMaps& pass, const test::Shot& s, int threads) {
    const auto view = scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, s.options.width,
                                       s.options.height);
    EXPECT_TRUE(view);
    const auto made = plan(s.options, facts(s.scene), *view);
    EXPECT_TRUE(made);
    Jobs jobs(threads);
    const shade::MipChains mips;
    const FrameLights lights(*made, *view, s.scene.mesh);
    pass.clear();
    for (const scene::ViewLight& light : lights.lights())
        pass.add({jobs, s.scene, *view, *made, mips}, light, s.options.shadow_size, false);
    std::vector<std::vector<float>> depths;
    for (const shade::ShadowMap& map : pass.maps())
        depths.emplace_back(map.depth, map.depth + map.size * map.size);
    return depths;
}

// Tiles that hold nothing are not cleared again: not so where something else was drawn, or where
// maps of other lights and sizes have taken the place.
TEST(ShadowMaps, AreThoseOfANewPassWhateverWasDrawnBefore) {
    test::Random random(12);
    constexpr int kThreads = 2;
    ShadowMaps kept(kThreads);
    int holes = 0;
    for (int round = 0; round < 80; ++round) {
        test::Shot s = test::solids("bodies");
        test::add_sphere(s.scene.mesh, Vec3(random.in_cube(0.9)), 0.1F, 9, 7, 0);
        s.camera.azimuth_degrees = random.in(0, 360);
        s.options.shadow_size = round % 10 < 5 ? 512 : 300;
        const int lights = random.whole(1, 3);
        for (int k = 0; k < lights; ++k) {
            scene::Light light = test::light_of(
                random.whole(0, 1) == 0 ? LightKind::directional : LightKind::point, 1);
            light.casts = true;
            light.towards = random.in_cube(1);
            light.position = random.in_cube(k == 0 ? 4 : 1); // within: six maps
            if (k == 0) s.options.lights.clear();
            s.options.lights.push_back(light);
        }
        ShadowMaps fresh(kThreads);
        const auto drawn = maps(fresh, s, kThreads);
        ASSERT_EQ(maps(kept, s, kThreads), drawn) << round;
        for (const auto& depth : drawn)
            holes += std::count(depth.begin(), depth.end(), 0.0F) > 3 * 64 * 64 ? 1 : 0;
    }
    EXPECT_GT(holes, 60);
}

} // namespace
} // namespace scanout::frame
