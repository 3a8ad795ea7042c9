// Whole pictures in the light of the scene.
#include "image/compare.h"
#include "support/scenes.h"
#include "support/srgb_formula.h"

#include <cmath>

namespace scanout::test {
namespace {

using scene::LightKind;

TEST(Lights, OfAPointLightAFloorByTheInverseSquareAndTheCosine) {
    Shot s = shot("floor", 64, 64);
    s.scene.materials = {plain(Vec3(0.8F))};
    add_square(s.scene.mesh, 4, 0, 0);
    scene::Light lamp = light_of(LightKind::point, 0.9);
    lamp.position = {0.4, -0.3, 1.25};
    lamp.colour = {1, 0.5F, 0.25F};
    for (const auto projection :
         {scene::Projection::perspective, scene::Projection::orthographic}) {
        s.camera.projection = projection;
        s.options.lights = {lamp};
        const image::Image picture = draw(s);
        const auto view = scene::make_view(s.scene.mesh, {}, {}, s.camera, {}, 64, 64);
        ASSERT_TRUE(view);
        const double half = projection == scene::Projection::perspective
                                ? view->half_width * view->centre_distance
                                : view->half_width;
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                const DVec3 at(half * ((x + 0.5) / 32 - 1), half * (1 - (y + 0.5) / 32), 0);
                const DVec3 way = lamp.position - at;
                const double square = dot3(way, way), reach = dot3(lamp.position, lamp.position);
                const double light = 0.9 * reach / square * way.z / std::sqrt(square);
                const int code[3] = {picture.at(x, y).r, picture.at(x, y).g, picture.at(x, y).b};
                for (int c = 0; c < 3; ++c) {
                    const double wanted = std::min(0.8 * light * lamp.colour[c], 1.0);
                    EXPECT_GE(wanted, decoded(std::max(0, code[c] - 1))) << x << ' ' << y;
                    EXPECT_LE(wanted, decoded(std::min(255, code[c] + 1))) << x << ' ' << y;
                }
            }
        }
    }
}

TEST(Lights, AreTheSameWhereTheNearPlaneCutsTheFloor) {
    // The same floor in one piece that runs behind the eye and in small ones that do not.
    const auto floor = [](int pieces) {
        Shot s = shot("floor", 64, 48);
        s.scene.materials = {plain(Vec3(0.7F))};
        for (int i = 0; i < pieces; ++i) {
            const auto z = [&](int k) {
                return 1 - 2 * static_cast<float>(k) / static_cast<float>(pieces);
            };
            add_quad(s.scene.mesh,
                     {{{-1, 0, z(i)}, {1, 0, z(i)}, {1, 0, z(i + 1)}, {-1, 0, z(i + 1)}}},
                     {0, 1, 0}, 0);
        }
        s.camera.eye = DVec3(0.1, 0.1, 0.3);
        s.camera.target = DVec3(0, 0, -0.4);
        scene::Light lamp = light_of(LightKind::point, 0.4);
        lamp.position = {0.1, 0.3, -0.2};
        s.options.lights = {lamp};
        return draw(s);
    };
    EXPECT_EQ(image::compare(floor(1), floor(32), 1).over_tolerance, 0);
}

TEST(Lights, ThatAreOffOrBlackChangeNoBit) {
    const scene::Light ambient = light_of(LightKind::ambient, 0.15);
    const image::Image plain = draw(stage("plain", {ambient}));
    for (const auto kind : {LightKind::directional, LightKind::point, LightKind::spot}) {
        Shot black = stage("black", {ambient, light_of(kind, 0)});
        EXPECT_EQ(draw(black), plain);
        Shot off = stage("off", {ambient, light_of(kind, 1)});
        EXPECT_NE(draw(off), plain);
        off.options.effects[std::string(name_of(kind)) + "_light"] = false;
        EXPECT_EQ(draw(off), plain);
    }
    Shot none = stage("none", {});
    const image::Image dark = draw(none);
    for (const image::Rgba8& p : dark.pixels()) {
        const bool black = p == image::Rgba8{0, 0, 0, 255};
        EXPECT_TRUE(black || p == none.options.background);
    }
}

TEST(Lights, OfTheWorldLightTheSamePlaceFromEverywhere) {
    // The floor of a room, seen from two sides: matt, so its middle looks the same.
    Shot s = shot("floor", 65, 65);
    s.scene.materials = {plain(Vec3(0.8F))};
    add_quad(s.scene.mesh, {{{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}}, {0, 1, 0}, 0);
    s.options.lights = {light_of(LightKind::spot, 1)};
    s.camera.elevation_degrees = 60;
    std::vector<image::Rgba8> middles;
    for (const double azimuth : {0.0, 90.0, 123.0, 270.0}) {
        s.camera.azimuth_degrees = azimuth;
        middles.push_back(draw(s).at(32, 32));
        EXPECT_EQ(middles.back(), middles.front()) << azimuth;
    }
    EXPECT_GT(middles.front().r, 60);
}

// Floats hold neither its surfaces' places nor their squares; the picture has a meaning all the
// same.
TEST(Lights, OfTheWorldAreTooWeakForAModelScaledBeyondAllFloats) {
    for (const auto kind : {scene::LightKind::point, scene::LightKind::spot}) {
        Shot s = solids("solids");
        scene::Light light, ambient;
        light.kind = kind;
        light.position = {0.5, 2, 3};
        ambient.kind = scene::LightKind::ambient;
        s.options.lights = {ambient};
        s.options.tone = "clamp"; // else the lamp's power alone would choose the curve
        s.camera.distance = 3;
        const image::Image dark = draw(s);
        for (const double exponent : {20, 41, 60, 100, 130, 300, 880}) {
            s.options.lights = {ambient, light};
            s.model.scale = DVec3(std::exp2(exponent));
            s.camera.distance = 3 * std::exp2(exponent);
            EXPECT_EQ(draw(s), dark) << exponent;
        }
        s.model.scale = DVec3(1);
        s.camera.distance = 3;
        EXPECT_NE(draw(s), dark);
    }
}

} // namespace
} // namespace scanout::test
