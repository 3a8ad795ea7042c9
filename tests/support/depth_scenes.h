// Scenes in which it matters which of two surfaces is seen, and how finely depth is kept.
#pragma once

#include "support/axes.h"
#include "support/shot.h"

namespace scanout::test {

// A ball and a cube that stand in each other, and two squares in one plane.
inline Shot depth_tested(std::string name, const std::string& test) {
    Shot s = shot(std::move(name));
    s.scene.materials = {plain({0.8F, 0.1F, 0.05F}), plain({0.1F, 0.6F, 0.2F}),
                         plain({0.9F, 0.8F, 0.1F}), plain({0.1F, 0.2F, 0.9F})};
    geom::Mesh& mesh = s.scene.mesh;
    add_cube(mesh, 0.4F, 1);
    add_sphere(mesh, {0.4F, 0.3F, 0.3F}, 0.4F, 24, 12, 0);
    for (const int material : {2, 3}) {
        const float x0 = material == 2 ? -0.9F : -0.7F, y1 = material == 2 ? -0.3F : -0.5F;
        add_quad(mesh, {{{x0, -0.9F, 0.5F}, {0, -0.9F, 0.5F}, {0, y1, 0.5F}, {x0, y1, 0.5F}}},
                 {0, 0, 1}, material);
    }
    mesh.uv.clear();
    s.options.depth_test = test;
    return s;
}

// Two squares that cross in an upright line, at an angle so small that two steps of a depth of 24
// bits lie between them at their sides.
inline void add_crossing(geom::Mesh& mesh, const Vec3& middle, float half_width, float half_height,
                         float lean, float tilt) {
    for (const int material : {0, 1}) {
        const float side = material == 0 ? lean : -lean;
        const auto corner = [&](float x, float y) {
            return Vec3{middle.x + x * half_width, middle.y + y * half_height,
                        middle.z + (x * side + y * tilt)};
        };
        add_quad(mesh, {{corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)}}, {0, 0, 1},
                 material);
    }
}

// Twice: at one and a half times the near plane's distance, on the left, and far away. The line
// between them should be straight, and in the middle of both.
inline Shot depth_kept(std::string name, const std::string& format) {
    Shot s = shot(std::move(name));
    s.scene.materials = {plain({0.8F, 0.1F, 0.05F}), plain({0.1F, 0.6F, 0.2F})};
    add_crossing(s.scene.mesh, {-0.003F, 0, 0}, 0.0027F, 0.0055F, 1.4e-9F, 0.002F);
    add_crossing(s.scene.mesh, {0.19F, 0, -0.9F}, 0.16F, 0.33F, 5e-6F, 0.05F);
    s.scene.mesh.uv.clear();
    // As the middle of a large model: else the near plane would come nearer, to where that ends.
    s.model.scale = DVec3(64);
    for (Vec3& p : s.scene.mesh.position)
        p = p / 64.0F;
    s.camera.eye = DVec3(0, 0, 0.015);
    s.camera.target = DVec3(0, 0, 0.015 - 0.01 * 16384); // the near plane is at 0.01
    s.options.depth = format;
    return s;
}

inline std::vector<Shot> depth_shots() {
    std::vector<Shot> shots;
    for (const std::string& name : names_on("depth"))
        shots.push_back(depth_kept("depth_" + name, name));
    for (const std::string& name : names_on("depth_test"))
        shots.push_back(depth_tested("depth_test_" + name, name));
    return shots;
}

} // namespace scanout::test
