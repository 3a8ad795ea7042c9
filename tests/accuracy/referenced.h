// A picture that tests ask for, with the reference of it.
#pragma once

#include "app/picture/reference.h"
#include "frame/facts/facts.h"
#include "io/load.h"
#include "measure/ladder.h"
#include "support/shot.h"
#include "trace/render.h"

#include <string>
#include <utility>

namespace scanout::test {

inline scene::View view_of(const Shot& s) {
    return *scene::make_view(s.scene.mesh, s.model, s.pose, s.camera, {}, s.options.width,
                             s.options.height);
}

// A model of models/, by its path in there.
inline Shot shipped(const std::string& path, int width, int height) {
    Shot s = shot(path, width, height);
    Warnings warnings;
    auto scene = io::load(SCANOUT_SOURCE_DIR "/models/" + path, {}, warnings);
    if (!scene) ADD_FAILURE() << scene.error().what;
    if (scene) s.scene = std::move(*scene);
    return s;
}

// In the light of a lamp under its ceiling, of a point where it has no size.
inline Shot cornell_box(int side, double light_size) {
    Shot s = shipped("cornell_box/cornell_box.obj", side, side);
    s.name += light_size == 0 ? " with a point of light" : " with a lamp";
    s.camera.azimuth_degrees = 180;
    s.options.cull = frame::Cull::back;
    scene::Light lamp;
    lamp.kind = scene::LightKind::point;
    lamp.position = {278, 500, 280};
    lamp.size = light_size;
    scene::Light ambient;
    ambient.kind = scene::LightKind::ambient;
    ambient.power = 0.15;
    s.options.lights = {lamp, ambient};
    return s;
}

// Of what is asked for, but for rungs.
inline trace::Reference reference_of(const Shot& s, const trace::Effort& effort) {
    const auto plan =
        frame::plan(measure::without_rungs(s.options), frame::facts(s.scene), view_of(s));
    if (!plan) ADD_FAILURE() << s.name << ": " << plan.error().what;
    if (!plan) return {};
    const auto look = app::look_of(*plan);
    if (!look) ADD_FAILURE() << s.name << ": " << look.error().what;
    if (!look) return {};
    Jobs jobs(2);
    return *trace::render(s.scene, view_of(s), *look, jobs, {}, effort);
}

} // namespace scanout::test
