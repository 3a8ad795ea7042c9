// The viewer's lights: the one that keys and mouse move, and the movement of each.
#include "app/view/viewer.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::app {

scene::LightMove& Viewer::light_move() {
    return state_.look.lights[static_cast<std::size_t>(state_.light)];
}

void Viewer::next_light() {
    if (lights_.empty()) return;
    state_.light = (state_.light + 1) % static_cast<int>(lights_.size());
}

// Turns in azimuth and elevation about the model, like the camera; the elevation stops at the
// poles.
void Viewer::turn_light(const scene::LightMove& from, std::int64_t right, std::int64_t up,
                        const geom::Mesh* mesh) {
    const scene::LightMove before = from; // `from` may be light_move() itself
    scene::LightMove& move = light_move();
    move.azimuth = scene::wrap_angle(before.azimuth + right);
    const scene::Light& light = lights_[static_cast<std::size_t>(state_.light)];
    const double own =
        mesh != nullptr ? place_of(light, state_.look.up, *mesh).elevation_degrees : 0;
    const auto pole = [&](double degrees) {
        return static_cast<std::int64_t>((degrees - own) * scene::kAngleUnitsPerDegree);
    };
    move.elevation = static_cast<int>(std::clamp(before.elevation + up, pole(-90), pole(90)));
}

void Viewer::brighten(int levels) {
    scene::LightMove& move = light_move();
    move.level = scene::clamp_zoom(std::int64_t{move.level} + levels);
}

std::vector<scene::Light> Viewer::lights(const geom::Mesh& mesh) const {
    std::vector<scene::Light> placed;
    place_lights(mesh, placed);
    return placed;
}

void Viewer::place_lights(const geom::Mesh& mesh, std::vector<scene::Light>& out) const {
    out = lights_; // reuses its memory
    if (motion_) motion_->move_lights(*motion_time(), out);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const scene::LightMove& move = state_.look.lights[i];
        if (!(move == scene::LightMove())) // without a move every bit stays
            out[i] = scene::moved(out[i], move, state_.look.up, mesh);
    }
}

std::string Viewer::light_line(const geom::Mesh& mesh, std::size_t letters) const {
    if (!moves_light()) return {};
    const scene::Light light = lights(mesh)[static_cast<std::size_t>(state_.light)];
    const scene::LightPlace place = place_of(light, state_.look.up, mesh);
    const auto line = [&](std::string_view azimuth, std::string_view elevation) {
        const std::string where =
            light.kind == scene::LightKind::ambient
                ? ""
                : fmt::format("  {} {:.0f}  {} {:.0f}", azimuth, place.azimuth_degrees, elevation,
                              place.elevation_degrees);
        return fmt::format("light {} of {}: {}{}  power {:.3g}", state_.light + 1, lights_.size(),
                           light.name, where, light.power);
    };
    const std::string whole = line("azimuth", "elevation");
    return whole.size() <= letters ? whole : line("az", "el");
}

} // namespace scanout::app
