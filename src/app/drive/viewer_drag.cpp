// Drags and the wheel: what the hand holds follows it.
#include "app/view/viewer.h"
#include "scene/view.h"

#include <algorithm>
#include <cstdlib>
#include <optional>

namespace scanout::app {
namespace {

constexpr int kOctavesOfADrag = 4; // of scale, from the picture's bottom to its top

} // namespace

void Viewer::begin_drag(const geom::Mesh* mesh) {
    const Result<scene::View> now = mesh != nullptr ? view(*mesh) : fail(Exit::usage, "no model");
    const bool line = state_.split && std::abs(state_.pointer.x - state_.split_x) <= split_step();
    drag_ = Drag{state_.look,
                 false,
                 line ? std::optional(state_.split_x) : std::nullopt,
                 now ? scene::world_units_per_pixel(*now, height_) : 0,
                 false,
                 {step_, 0, 0},
                 {step_, 0, 0},
                 0};
}

void Viewer::drag(const Action& action, const geom::Mesh* mesh) {
    if (!drag_) begin_drag(mesh);
    if (drag_->split_x) return put_split(std::int64_t{*drag_->split_x} + action.numbers[0]);
    const auto [dx, dy, unused] = action.numbers;
    drag_->farthest = std::max({drag_->farthest, std::abs(dx), std::abs(dy)});
    const Look& start = drag_->start;
    Look& look = state_.look;
    if (look.flies && !moves_light()) {
        if (mesh != nullptr) drag_flight(action, *mesh);
        return remember_drag();
    }
    if (action.id == ActionId::drag_zoom) {
        const std::int64_t levels =
            -std::int64_t{dy} * kOctavesOfADrag * scene::kZoomLevelsPerOctave / height_;
        (state_.camera_mode ? look.orbit.zoom : look.pose.zoom) =
            scene::clamp_zoom((state_.camera_mode ? start.orbit.zoom : start.pose.zoom) + levels);
    } else if (action.id == ActionId::drag_move) {
        const double units = drag_->units_per_pixel * scene::kPanUnitsPerRadius;
        const double x = units * dx, y = -units * dy;
        if (state_.camera_mode) {
            look.orbit.pan_x = moved(start.orbit.pan_x, -x);
            look.orbit.pan_y = moved(start.orbit.pan_y, -y);
        } else {
            look.pose.pan_x = moved(start.pose.pan_x, x);
            look.pose.pan_y = moved(start.pose.pan_y, y);
        }
    } else {
        const std::int64_t turn_x = angle_of_pixels(dx), turn_y = angle_of_pixels(dy);
        drag_->turns = action.id == ActionId::drag_rotate && !moves_light();
        follow_turn(turn_x, turn_y);
        if (action.id == ActionId::drag_rotate && moves_light()) {
            turn_light(start.lights[static_cast<std::size_t>(state_.light)], turn_x, -turn_y, mesh);
        } else if (action.id == ActionId::drag_roll) {
            int& roll = state_.camera_mode ? look.orbit.roll : look.pose.roll;
            roll = scene::wrap_angle((state_.camera_mode ? start.orbit.roll : start.pose.roll) -
                                     turn_x);
        } else if (state_.camera_mode) {
            // What is seen follows the hand: the camera goes the other way.
            look.orbit.azimuth = scene::wrap_angle(start.orbit.azimuth - turn_x);
            look.orbit.elevation = clamped_elevation(start.orbit.elevation + turn_y);
        } else {
            look.pose.yaw = scene::wrap_angle(start.pose.yaw + turn_x);
            look.pose.pitch = scene::wrap_angle(start.pose.pitch + turn_y);
        }
    }
    remember_drag();
}

void Viewer::remember_drag() {
    if (drag_->remembered || state_.look == drag_->start) return;
    remember(drag_->start);
    drag_->remembered = true;
}

// Scales so that the point under the pixel (x, y), in the plane through the model's centre, stays.
void Viewer::zoom_at(int levels, int x, int y, const geom::Mesh* mesh) {
    const Result<scene::View> now = mesh != nullptr ? view(*mesh) : fail(Exit::usage, "no model");
    if (!now) return zoom(levels);
    const double unit = scene::world_units_per_pixel(*now, height_);
    const double right = (x + 0.5 - width_ * 0.5) * unit;
    const double up = (height_ * 0.5 - y - 0.5) * unit;
    if (!state_.camera_mode) {
        // zoom_towards takes the model's centre to stand at its pan; it really stands here:
        scene::Pose& pose = state_.look.pose;
        const double pan_x = static_cast<double>(pose.pan_x) / scene::kPanUnitsPerRadius;
        const double pan_y = static_cast<double>(pose.pan_y) / scene::kPanUnitsPerRadius;
        return scene::zoom_towards(pose, levels, right - (now->translation.x - pan_x),
                                   up - (now->translation.y - pan_y));
    }
    scene::Orbit& orbit = state_.look.orbit;
    const int before = orbit.zoom;
    zoom(levels);
    const double kept = 1 - 1 / scene::zoom_scale(orbit.zoom - before);
    orbit.pan_x = moved(orbit.pan_x, right * kept * scene::kPanUnitsPerRadius);
    orbit.pan_y = moved(orbit.pan_y, up * kept * scene::kPanUnitsPerRadius);
}

} // namespace scanout::app
