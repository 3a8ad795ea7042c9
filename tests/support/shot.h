// What tests draw: a scene with its view and options.
#pragma once

#include "frame/renderer.h"
#include "support/meshes.h"
#include "support/pixel_view.h"

#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::test {

struct Shot {
    std::string name;
    scene::Scene scene;
    scene::CameraOptions camera;
    scene::ModelTransform model;
    scene::Pose pose;
    frame::FrameOptions options;

    friend void PrintTo(const Shot& s, std::ostream* out) { *out << s.name; }
};

struct DrawOptions {
    int threads = 1, tile_size = 64;
    frame::FrameStats* stats = nullptr;
    frame::Visibility* visibility = nullptr;
    shade::LinearPicture* linear = nullptr;
};

inline image::Image draw(const Shot& shot, const scene::View& view, const DrawOptions& options) {
    const auto plan =
        frame::plan(shot.options, frame::facts(shot.scene, shot.options.shadow_plane), view);
    if (!plan) ADD_FAILURE() << shot.name << ": " << plan.error().what;
    if (!plan) return {};
    Jobs jobs(options.threads);
    frame::Renderer renderer(jobs);
    image::Image picture = renderer.render(shot.scene, view, *plan, options.visibility,
                                           options.tile_size, options.linear);
    if (options.stats != nullptr) *options.stats = renderer.stats();
    return picture;
}
inline image::Image draw(const Shot& shot, const DrawOptions& options = {}) {
    const auto view = scene::make_view(shot.scene.mesh, shot.model, shot.pose, shot.camera, {},
                                       shot.options.width, shot.options.height);
    if (!view) ADD_FAILURE() << shot.name << ": " << view.error().what;
    return view ? draw(shot, *view, options) : image::Image();
}
// Straight on: mesh x and y are pixels, z is depth.
inline image::Image draw_in_pixels(const Shot& shot, const DrawOptions& options = {}) {
    return draw(shot, pixel_view(shot.options.width, shot.options.height), options);
}

inline Shot shot(std::string name, int width = 64, int height = 64) {
    Shot s;
    s.name = std::move(name);
    s.scene.mesh = empty_mesh();
    s.options.width = width;
    s.options.height = height;
    return s;
}

} // namespace scanout::test
