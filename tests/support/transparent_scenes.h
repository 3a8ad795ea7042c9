// Scenes with surfaces that let light through: panes and leaves.
#pragma once

#include "support/axes.h"
#include "support/shot.h"

namespace scanout::test {

inline scene::Material glass(const Vec3& kd, float d) {
    scene::Material material = plain(kd);
    material.opacity = d;
    return material;
}

// Eight by eight: a disc of alpha 255 in 0, or of a slope from 255 in the middle to 0.
inline scene::Texture leaf(bool soft) {
    image::Image image(8, 8);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            const int dx = 2 * x - 7, dy = 2 * y - 7, from_middle = dx * dx + dy * dy;
            const int alpha = soft ? std::max(0, 255 - 5 * from_middle) : (from_middle < 40) * 255;
            image.at(x, y) = {static_cast<std::uint8_t>(20 * x),
                              static_cast<std::uint8_t>(230 - 15 * y), 60,
                              static_cast<std::uint8_t>(alpha)};
        }
    }
    return {soft ? "soft leaf" : "leaf", image};
}

// Three panes that stand in each other, before a ball; and two leaves, one with a soft edge.
inline Shot panes(std::string name, const std::string& transparency) {
    Shot s = shot(std::move(name));
    s.scene.materials = {plain({0.8F, 0.7F, 0.6F}),
                         glass({0.9F, 0.1F, 0.1F}, 0.6F),
                         glass({0.1F, 0.8F, 0.1F}, 0.5F),
                         glass({0.1F, 0.2F, 0.9F}, 0.4F),
                         textured(0),
                         textured(1)};
    s.scene.textures = {leaf(false), leaf(true)};
    geom::Mesh& mesh = s.scene.mesh;
    add_quad(
        mesh,
        {{{-0.8F, -0.6F, 0.5F}, {0.7F, -0.6F, -0.5F}, {0.7F, 0.7F, -0.5F}, {-0.8F, 0.7F, 0.5F}}},
        {0.6F, 0, 0.8F}, 1);
    add_sphere(mesh, {0.1F, 0, -0.3F}, 0.45F, 24, 12, 0);
    add_quad(
        mesh,
        {{{-0.7F, -0.5F, -0.6F}, {0.8F, -0.5F, 0.4F}, {0.8F, 0.6F, 0.4F}, {-0.7F, 0.6F, -0.6F}}},
        {-0.6F, 0, 0.8F}, 2);
    add_quad(
        mesh,
        {{{-0.9F, -0.1F, 0.6F}, {0.9F, -0.1F, 0.6F}, {0.9F, 0.2F, -0.6F}, {-0.9F, 0.2F, -0.6F}}},
        {0, 0.97F, 0.24F}, 3);
    add_quad(
        mesh,
        {{{-0.9F, 0.3F, 0.2F}, {-0.2F, 0.3F, 0.2F}, {-0.2F, 0.95F, 0.2F}, {-0.9F, 0.95F, 0.2F}}},
        {0, 0, 1}, 4);
    add_quad(mesh,
             {{{0.1F, 0.3F, 0.2F}, {0.9F, 0.3F, 0.2F}, {0.9F, 0.95F, 0.2F}, {0.1F, 0.95F, 0.2F}}},
             {0, 0, 1}, 5);
    s.options.transparency = transparency;
    s.options.texture = "bilinear";
    return s;
}

// A white disc on black.
inline scene::Texture disc() {
    scene::Texture texture = leaf(false);
    texture.path = "disc";
    for (image::Rgba8& texel : texture.image.pixels())
        texel = {texel.a, texel.a, texel.a, 255};
    return texture;
}

// A cube of which a map leaves discs.
inline Shot holed_cube(std::string name) {
    Shot s = shot(std::move(name));
    s.scene.materials = {plain({0.2F, 0.6F, 0.3F})};
    s.scene.materials[0].map_opacity.edit().texture = 0;
    s.scene.textures = {disc()};
    add_cube(s.scene.mesh, 0.57F, 0);
    s.camera.azimuth_degrees = 35;
    s.camera.elevation_degrees = 30;
    return s;
}

inline std::vector<Shot> transparent_shots() {
    std::vector<Shot> shots;
    shots.push_back(holed_cube("map_opacity"));
    for (const std::string& name : names_on("transparency"))
        shots.push_back(panes("transparency_" + name, name));
    for (const std::string& name : names_on("blend")) {
        shots.push_back(panes("blend_" + name, "exact"));
        shots.back().options.blend = name;
        shots.back().options.background = {150, 150, 150, 255};
    }
    return shots;
}

// On a floor, from the lamp on: a leaf that is cut out, a ball, and a sheet of glass with a soft
// leaf on it. The leaf and the ball throw shadows, on the glass, too; what is blended throws none.
inline Shot shadowed_panes(std::string name, const std::string& shadow, const scene::Light& lamp,
                           const scene::Light& ambient) {
    Shot s = shot(std::move(name));
    s.scene.materials = {plain(Vec3(0.7F)), plain({0.8F, 0.3F, 0.2F}), textured(0),
                         glass({0.2F, 0.5F, 0.9F}, 0.4F), textured(1)};
    s.scene.textures = {leaf(false), leaf(true)};
    geom::Mesh& mesh = s.scene.mesh;
    add_quad(mesh, {{{-1, -0.5F, 1}, {1, -0.5F, 1}, {1, -0.5F, -1}, {-1, -0.5F, -1}}}, {0, 1, 0},
             0);
    const auto upright = [&](float x, float z, float width, float height, int material) {
        add_quad(mesh,
                 {{{x, -0.5F, z},
                   {x + width, -0.5F, z},
                   {x + width, height - 0.5F, z},
                   {x, height - 0.5F, z}}},
                 {0, 0, 1}, material);
    };
    upright(-0.9F, -0.6F, 0.8F, 0.8F, 2);
    add_sphere(mesh, {0.4F, -0.2F, -0.2F}, 0.3F, 24, 12, 1);
    upright(-0.6F, 0.4F, 1.2F, 0.5F, 3);
    upright(-0.9F, 0.6F, 0.4F, 0.4F, 4);
    s.camera.azimuth_degrees = 15;
    s.camera.elevation_degrees = 30;
    s.camera.distance = 2.6;
    s.options.lights = {lamp, ambient};
    s.options.shadow = shadow;
    s.options.shadow_size = 256;
    s.options.texture = "bilinear";
    return s;
}

} // namespace scanout::test
