// Steps of keys: the model, the camera or a light turns, moves and scales.
#include "app/view/viewer.h"

#include <algorithm>

namespace scanout::app {

// In model mode the front of the model goes right and up; in camera mode the camera does; a light
// that is selected goes instead of either.
void Viewer::rotate(int right, int up, const geom::Mesh* mesh) {
    Look& look = state_.look;
    if (moves_light()) return turn_light(light_move(), right, up, mesh);
    if (state_.camera_mode) {
        look.orbit.azimuth = scene::wrap_angle(look.orbit.azimuth + right);
        look.orbit.elevation = clamped_elevation(std::int64_t{look.orbit.elevation} + up);
    } else {
        look.pose.yaw = scene::wrap_angle(look.pose.yaw + right);
        look.pose.pitch = scene::wrap_angle(look.pose.pitch - up);
    }
}

std::int64_t Viewer::moved(std::int64_t pan, double by_units) {
    constexpr double kLimit = 0x1p52;
    const double units = std::clamp(static_cast<double>(pan) + by_units, -kLimit, kLimit);
    return static_cast<std::int64_t>(units + (units < 0 ? -0.5 : 0.5));
}

void Viewer::move(std::int64_t right, std::int64_t up) {
    Look& look = state_.look;
    std::int64_t& x = state_.camera_mode ? look.orbit.pan_x : look.pose.pan_x;
    std::int64_t& y = state_.camera_mode ? look.orbit.pan_y : look.pose.pan_y;
    x = moved(x, static_cast<double>(right));
    y = moved(y, static_cast<double>(up));
}

// The model comes towards the eye, or the camera towards what it looks at.
void Viewer::move_in_depth(std::int64_t near) {
    Look& look = state_.look;
    if (state_.camera_mode)
        look.orbit.pan_z = moved(look.orbit.pan_z, -static_cast<double>(near));
    else
        look.pose.pan_z = moved(look.pose.pan_z, static_cast<double>(near));
}

scene::ModelTransform Viewer::model() const {
    scene::ModelTransform model = model_;
    for (int axis = 0; axis < 3; ++axis)
        if (const int levels = state_.look.stretch[static_cast<std::size_t>(axis)]; levels != 0)
            model.scale[axis] *= scene::zoom_scale(levels);
    return model;
}

// Along the axis that is chosen, or along all.
void Viewer::scale(int levels) {
    if (state_.scale_axis < 0) return zoom(levels);
    int& stretch = state_.look.stretch[static_cast<std::size_t>(state_.scale_axis)];
    stretch = scene::clamp_zoom(std::int64_t{stretch} + levels);
}

void Viewer::zoom(int levels) {
    int& level = state_.camera_mode ? state_.look.orbit.zoom : state_.look.pose.zoom;
    level = scene::clamp_zoom(std::int64_t{level} + levels);
}

// The named views forget how the model and the camera are turned, moved and zoomed: it fits.
void Viewer::look_from(int view) {
    Look& look = state_.look;
    look.view = view;
    look.pose = {};
    look.orbit = {};
    look.flight = {};
    look.flies = false;
}

// The orbit adds to the camera's own elevation; together they stop at the poles.
int Viewer::clamped_elevation(std::int64_t units) const {
    const scene::CameraOptions now = camera();
    if (now.eye) return scene::clamp_elevation(units);
    constexpr double kPole = 90;
    const auto to_units = [](double degrees) {
        return static_cast<std::int64_t>(degrees * scene::kAngleUnitsPerDegree);
    };
    const double own = std::clamp(now.elevation_degrees, -kPole, kPole);
    return static_cast<int>(std::clamp(units, to_units(-kPole - own), to_units(kPole - own)));
}

// 180 degrees for the picture's height, rounded: the same total gives the same angle, whatever the
// steps in which the mouse went.
std::int64_t Viewer::angle_of_pixels(int pixels) const {
    constexpr std::int64_t kHalfTurn = scene::kFullTurn / 2;
    const std::int64_t doubled = 2 * kHalfTurn * pixels;
    return (doubled + (doubled < 0 ? -height_ : height_)) / (2 * std::int64_t{height_});
}

} // namespace scanout::app
