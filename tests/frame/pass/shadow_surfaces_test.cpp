// Shadows and surfaces that let light through, shadows that no pass makes, and shadows of scenes of
// any size.
#include "image/compare.h"
#include "support/axes.h"
#include "support/scenes.h"
#include "support/transparent_scenes.h"

#include <algorithm>

namespace scanout::test {
namespace {

using scene::LightKind;

const Names& kTechniques = names_on("shadow");

// A floor that faces the eye, and before it a square of another material.
Shot before_a_floor(const scene::Material& material, float left, float right) {
    Shot s = shot("before a floor", 64, 64);
    s.scene.materials = {plain(Vec3(0.8F)), material};
    scene::Texture half; // alpha 0 left, 255 right
    half.image = image::Image(2, 1);
    half.image.at(0, 0) = {200, 200, 200, 0};
    half.image.at(1, 0) = {200, 200, 200, 255};
    s.scene.textures = {half};
    geom::Mesh& mesh = s.scene.mesh;
    add_quad(mesh, {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}, {0, 0, 1}, 0);
    add_quad(mesh,
             {{{left, -0.4F, 0.5F}, {right, -0.4F, 0.5F}, {right, 0.4F, 0.5F}, {left, 0.4F, 0.5F}}},
             {0, 0, 1}, 1);
    s.camera.projection = scene::Projection::orthographic;
    scene::Light light = light_of(LightKind::directional, 0.9);
    light.towards = {1, 1.5, 1};
    light.casts = true;
    s.options.lights = {light, light_of(LightKind::ambient, 0.15)};
    s.options.texture = "nearest";
    s.options.tone = "clamp"; // whatever else the scene has
    s.options.shadow_size = 512;
    return s;
}

struct Floor {
    image::Image picture;
    std::vector<bool> shown; // the pixel shows it
    frame::FrameStats stats;
};
Floor floor_of(const Shot& s, const std::string& technique) {
    Shot drawn = s;
    drawn.options.shadow = technique;
    frame::Visibility seen;
    Floor floor;
    floor.picture = draw(drawn, {.stats = &floor.stats, .visibility = &seen});
    for (const std::uint32_t id : seen.id)
        floor.shown.push_back(id < 2);
    return floor;
}

// Pixels of both floors that differ; both must show many.
int differing(const Floor& a, const Floor& b) {
    int both = 0, different = 0;
    for (int y = 0; y < a.picture.height(); ++y) {
        for (int x = 0; x < a.picture.width(); ++x) {
            const auto i = static_cast<std::size_t>(y * a.picture.width() + x);
            if (!a.shown[i] || !b.shown[i]) continue;
            ++both;
            different += a.picture.at(x, y) != b.picture.at(x, y) ? 1 : 0;
        }
    }
    EXPECT_GT(both, 800);
    return different;
}

TEST(ShadowSurfaces, WhatIsCutOutThrowsItsHolesInMaps) {
    const Shot cut = before_a_floor(textured(0), -0.6F, 0.6F);
    const Shot half = before_a_floor(plain(Vec3(0.8F)), 0, 0.6F),
               whole = before_a_floor(plain(Vec3(0.8F)), -0.6F, 0.6F);
    ASSERT_EQ(frame::facts(cut.scene).alpha.cut_out_triangles, 2U);
    for (const char* technique : {"map", "map_pcf", "map_soft"}) {
        const Floor holes = floor_of(cut, technique);
        EXPECT_LE(differing(holes, floor_of(half, technique)), 8) << technique;
        EXPECT_GT(differing(holes, floor_of(whole, technique)), 100) << technique;
    }
    // Polygons know no holes.
    for (const char* technique : {"volume", "projected"})
        EXPECT_EQ(differing(floor_of(cut, technique), floor_of(whole, technique)), 0) << technique;
}

TEST(ShadowSurfaces, WhatIsBlendedThrowsNone) {
    const Shot pane = before_a_floor(glass(Vec3(0.8F), 0.5F), -0.6F, 0.6F);
    const Shot whole = before_a_floor(plain(Vec3(0.8F)), -0.6F, 0.6F);
    for (const std::string& technique : kTechniques) {
        Shot lit = pane;
        lit.options.effects["shadow"] = false;
        EXPECT_EQ(floor_of(pane, technique).picture, floor_of(lit, technique).picture) << technique;
        if (technique == "attached") continue;
        Shot opaque = pane;
        opaque.options.effects["blending"] = false;
        EXPECT_EQ(differing(floor_of(opaque, technique), floor_of(whole, technique)), 0)
            << technique;
    }
}

TEST(ShadowSurfaces, WhatIsBlendedReceivesWhatAnOpaqueSurfaceWould) {
    for (const int samples : {1, 4}) {
        Shot s = before_a_floor(plain(Vec3(0.8F)), -0.6F, 0.6F);
        s.options.samples = samples;
        for (const std::string& technique : kTechniques) {
            Shot pane = s;
            pane.scene.materials[0] = glass(Vec3(0.8F), 0.5F); // the floor
            pane.options.background = {0, 0, 0, 255};
            pane.options.shadow = s.options.shadow = technique;
            s.options.background = pane.options.background;
            shade::LinearPicture through, whole;
            draw(pane, {.linear = &through});
            draw(s, {.linear = &whole});
            int dark = 0, compared = 0;
            for (std::size_t i = 0; i < whole.pixel.size(); ++i) {
                // Pixels that show the floor alone let half of the background through.
                if (whole.pixel[i][3] != 1 || through.pixel[i][3] != 0.5F) continue;
                ++compared;
                dark += whole.pixel[i][0] < 0.2F ? 1 : 0;
                EXPECT_NEAR(through.pixel[i][0], whole.pixel[i][0] / 2, 1e-6)
                    << technique << ' ' << i << ' ' << samples;
            }
            EXPECT_GT(compared, 800) << technique;
            if (technique != "attached") {
                EXPECT_GT(dark, 100) << technique;
            }
        }
    }
}

TEST(ShadowSurfaces, AttachedIsWhatTheReflectionLeavesDark) {
    for (const auto kind : {LightKind::directional, LightKind::point, LightKind::spot}) {
        Shot s = shadowed("attached", "attached", kind);
        frame::FrameStats stats;
        const image::Image attached = draw(s, {.stats = &stats});
        EXPECT_EQ(stats.shadow_bytes, 0U);
        s.options.effects["shadow"] = false;
        EXPECT_EQ(draw(s), attached);
    }
}

// Test builds check every lane of every stage.
TEST(ShadowSurfaces, KeepLightFiniteAtAnyScaleOfTheModel) {
    for (const auto kind : {LightKind::directional, LightKind::point}) {
        for (const std::string& technique : kTechniques) {
            for (const double scale : {1e-30, 1e-6, 1e6, 1e30, 1e200}) {
                Shot s = shadowed("scale", technique, kind);
                s.model.scale = DVec3(scale);
                s.camera.distance = 2.5 * std::max(scale, 1.0);
                s.options.lights[0].size = 0.1;
                frame::FrameStats stats;
                draw(s, {.stats = &stats});
                const bool map = technique.starts_with("map");
                EXPECT_TRUE(!map || stats.shadow_bytes > 0) << technique << ' ' << scale;
            }
        }
    }
}

} // namespace
} // namespace scanout::test
