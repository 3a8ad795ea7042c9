// Pictures of models by textbook renderers and by the production renderer, from the same view.
#pragma once

#include "support/shot.h"
#include "textbook/render.h"

namespace scanout::textbook::test {

using scanout::test::Shot;

inline Look look_of(const Shot& shot) {
    Look look;
    look.width = shot.options.width;
    look.height = shot.options.height;
    look.background = shot.options.background;
    look.lights = shot.options.lights;
    look.left = static_cast<Left>(shot.options.cull);
    return look;
}
inline scene::View view_of(const Shot& shot) {
    const auto view = scene::make_view(shot.scene.mesh, shot.model, shot.pose, shot.camera, {},
                                       shot.options.width, shot.options.height);
    EXPECT_TRUE(view);
    return view ? *view : scene::View{};
}
inline image::Image picture(const Shot& shot, const Parts& parts = {}) {
    return render(shot.scene, view_of(shot), look_of(shot), parts).image;
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

} // namespace scanout::textbook::test
