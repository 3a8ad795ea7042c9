// Pictures of models by textbook renderers and by the production renderer, from the same view.
#pragma once

#include "io/load.h"
#include "support/shot.h"
#include "textbook/render.h"

#include <cmath>
#include <string>

namespace scanout::textbook::test {

using scanout::test::Shot;

inline Look look_of(const Shot& shot) {
    Look look;
    look.width = shot.options.width;
    look.height = shot.options.height;
    look.background = shot.options.background;
    look.lights = shot.options.lights;
    look.left = shot.options.cull == frame::Cull::back    ? Left::backs
                : shot.options.cull == frame::Cull::front ? Left::fronts
                                                          : Left::none;
    return look;
}
inline scene::View view_of(const Shot& shot) {
    const auto view = scene::make_view(shot.scene.mesh, shot.model, shot.pose, shot.camera, {},
                                       shot.options.width, shot.options.height);
    EXPECT_TRUE(view);
    return view ? *view : scene::View{};
}
inline image::Image picture(const Shot& shot, const scene::View& view, const Parts& parts) {
    return render(shot.scene, view, look_of(shot), parts).image;
}
inline image::Image picture(const Shot& shot, const Parts& parts = {}) {
    return picture(shot, view_of(shot), parts);
}
// Of the folder models.
inline Shot shot_of_model(const std::string& name, int width, int height) {
    Shot s = scanout::test::shot(name, width, height);
    Warnings warnings;
    auto scene = io::load(std::string(SCANOUT_SOURCE_DIR "/models/") + name, {}, warnings);
    EXPECT_TRUE(scene) << name;
    if (scene) s.scene = std::move(*scene);
    return s;
}
inline Parts with(Hidden hidden) {
    Parts parts;
    parts.hidden = hidden;
    return parts;
}

inline int different_pixels(const image::Image& a, const image::Image& b, int more_than = 0) {
    EXPECT_EQ(a.width(), b.width());
    EXPECT_EQ(a.height(), b.height());
    int count = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const image::Rgba8 &p = a.pixels()[i], &q = b.pixels()[i];
        const auto differ = [&](int u, int v) { return u - v > more_than || v - u > more_than; };
        count += differ(p.r, q.r) || differ(p.g, q.g) || differ(p.b, q.b) ? 1 : 0;
    }
    return count;
}

// Three beams, each over the next one.
inline Shot ring() {
    Shot s = scanout::test::shot("ring", 96, 72);
    for (int i = 0; i < 3; ++i) {
        scene::Material m = scanout::test::plain(Vec3(0.05F));
        m.diffuse[i] = 0.8F;
        s.scene.materials.push_back(m);
        // Of a triangle with long sides: a beam along one side, from low to high.
        const double turn = 2 * 3.14159265358979 * i / 3;
        const auto at = [&](double along, double across, double z) {
            const double c = std::round(std::cos(turn) * 4096) / 4096,
                         n = std::round(std::sin(turn) * 4096) / 4096;
            return Vec3(static_cast<float>(along * c - across * n),
                        static_cast<float>(along * n + across * c), static_cast<float>(z));
        };
        scanout::test::add_quad(s.scene.mesh,
                                {at(-0.85, -0.4, -0.3), at(0.85, -0.4, 0.3), at(0.85, -0.15, 0.3),
                                 at(-0.85, -0.15, -0.3)},
                                {0, 0, 1}, i);
    }
    return s;
}

// Pixels that are not the background.
inline int covered_pixels(const image::Image& picture, const Shot& shot) {
    return different_pixels(picture, {picture.width(), picture.height(), shot.options.background});
}

} // namespace scanout::textbook::test
