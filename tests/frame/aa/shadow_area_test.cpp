// Projected shadows in pictures by exact areas: what a pixel shows need not lie at its centre.
#include "support/scenes.h"

namespace scanout::test {
namespace {

constexpr int kStripsSide = 64;
constexpr double kLightSlope = 50; // of the light: pixels aside for one of height

// Strips of floor, 0.3 pixels high, between the centres of pixels or over them, and a roof whose
// shadow begins at x = 20.
Shot floor_strips(double from_top) {
    Shot s = shot("strips", kStripsSide, kStripsSide);
    s.scene.materials = {plain(Vec3(1))};
    for (int y = 3; y < kStripsSide - 3; y += 3) {
        const auto low = static_cast<float>(y + from_top), high = low + 0.3F;
        add_quad(s.scene.mesh,
                 {{{2, low, 0.2F}, {40, low, 0.2F}, {40, high, 0.2F}, {2, high, 0.2F}}}, {0, 0, 1},
                 0);
    }
    const float shift = 0.6F * kLightSlope;
    add_quad(s.scene.mesh,
             {{{20 + shift, 0, 0.8F},
               {62, 0, 0.8F},
               {62, kStripsSide, 0.8F},
               {20 + shift, kStripsSide, 0.8F}}},
             {0, 0, 1}, 0);
    s.scene.mesh.uv.clear();
    scene::Light light = light_of(scene::LightKind::directional, 20);
    light.towards = {kLightSlope, 0, 1};
    light.casts = true;
    s.options.lights = {light};
    s.options.tone = "clamp";
    s.options.shadow = "projected";
    s.options.shadow_plane = frame::FilePlane{{0, 0, 1}, 0.2};
    s.options.aa = "area";
    return s;
}

TEST(ShadowByAreas, IsAskedForWhereEachPartIsShaded) {
    for (const double from_top : {0.1, 0.35, 0.6}) { // beside all centres, over them, beside them
        shade::LinearPicture linear;
        draw_in_pixels(floor_strips(from_top), {.linear = &linear});
        int lit = 0, dark = 0;
        for (int y = 0; y < kStripsSide; ++y)
            for (int x = 2; x < 32; ++x) {
                const double share = double{linear.at(x, y)[3]};
                if (share == 0) continue;
                ASSERT_NEAR(share, 0.3, 1e-2);
                const double light = double{linear.at(x, y)[0]} / share;
                const double full = 20 / std::sqrt(kLightSlope * kLightSlope + 1);
                ASSERT_NEAR(light, x < 20 ? full : 0, 1e-3) << x << ',' << y;
                ++(x < 20 ? lit : dark);
            }
        EXPECT_GT(lit, 300);
        EXPECT_GT(dark, 200);
    }
}

} // namespace
} // namespace scanout::test
