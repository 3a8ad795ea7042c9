// The camera that flies: it leaves the orbit where it is, and the orbit stays what it was.
#include "app/view/viewer.h"
#include "math/rotation.h"
#include "math/transcendental.h"
#include "scene/view.h"

#include <algorithm>

namespace scanout::app {
namespace {

constexpr double kFlyUnits = scene::kPanUnitsPerRadius / 64.0; // a step
constexpr int kLookStep = 2 * scene::kAngleUnitsPerDegree;
constexpr int kMostDoublings = 6;
constexpr int kLookShare = 4; // a drag looks around this much slower than it turns a model

} // namespace

Result<scene::View> Viewer::view_from_orbit(const geom::Mesh& mesh) const {
    const Moment now = moment(mesh);
    return scene::make_view(mesh, now.model, state_.look.pose, now.camera, state_.look.orbit,
                            width_, height_);
}

// Back on the orbit everything is as before the flight.
void Viewer::toggle_fly() {
    Look& look = state_.look;
    look.flies = !look.flies;
    look.flight = {};
    if (!look.flies) return;
    look.projection = scene::Projection::perspective; // without it nothing comes nearer
    answer_ = "camera: flies (W A S D E C, arrows look; Tab: back)";
}

bool Viewer::fly(const Action& action, const geom::Mesh* mesh) {
    if (action.id == ActionId::toggle_fly) {
        toggle_fly();
        return true;
    }
    if (!state_.look.flies) return is_flying(action.id);
    if (moves_light() || mesh == nullptr) return is_flying(action.id);
    const double step =
        kFlyUnits * scene::zoom_scale(state_.fly_speed * scene::kZoomLevelsPerOctave);
    const scene::Flight from = state_.look.flight;
    switch (action.id) {
    case ActionId::fly_forward:
    case ActionId::move_far:
        fly_by({0, 0, -step}, *mesh);
        break;
    case ActionId::fly_back:
    case ActionId::move_near:
        fly_by({0, 0, step}, *mesh);
        break;
    case ActionId::fly_left:
    case ActionId::move_left:
        fly_by({-step, 0, 0}, *mesh);
        break;
    case ActionId::fly_right:
    case ActionId::move_right:
        fly_by({step, 0, 0}, *mesh);
        break;
    case ActionId::fly_up:
    case ActionId::move_up:
        fly_by({0, step, 0}, *mesh);
        break;
    case ActionId::fly_down:
    case ActionId::move_down:
        fly_by({0, -step, 0}, *mesh);
        break;
    case ActionId::rotate_left:
        look_by(kLookStep, 0, from, *mesh);
        break;
    case ActionId::rotate_right:
        look_by(-kLookStep, 0, from, *mesh);
        break;
    case ActionId::rotate_up:
        look_by(0, kLookStep, from, *mesh);
        break;
    case ActionId::rotate_down:
        look_by(0, -kLookStep, from, *mesh);
        break;
    case ActionId::zoom_at:
        fly_by({0, 0, -step * action.numbers[0]}, *mesh);
        break;
    case ActionId::scale_up:
    case ActionId::scale_down:
        state_.fly_speed = std::clamp(state_.fly_speed + (action.id == ActionId::scale_up ? 1 : -1),
                                      -kMostDoublings, kMostDoublings);
        answer_ = fmt::format("speed: {:g} times",
                              scene::zoom_scale(state_.fly_speed * scene::kZoomLevelsPerOctave));
        break;
    case ActionId::roll_left:
    case ActionId::roll_right:
        answer_ = "a camera that flies does not roll; Tab: back to the orbit";
        break;
    default:
        return false;
    }
    return true;
}

// Along the camera's own axes, x right, y up, z back.
void Viewer::fly_by(const DVec3& units, const geom::Mesh& mesh) {
    const Result<scene::View> base = view_from_orbit(mesh);
    if (!base) return;
    scene::Flight& flight = state_.look.flight;
    const DVec3 way = transpose(scene::turn_of(flight, scene::rotation_of(*base))) * units;
    flight.x = moved(flight.x, way.x);
    flight.y = moved(flight.y, way.y);
    flight.z = moved(flight.z, way.z);
}

// Up and down end before the poles, where left and right would lose their meaning.
void Viewer::look_by(std::int64_t left, std::int64_t up, const scene::Flight& from,
                     const geom::Mesh& mesh) {
    constexpr double kSteepest = 89 * scene::kAngleUnitsPerDegree;
    const Result<scene::View> base = view_from_orbit(mesh);
    if (!base) return;
    const DMat3 rotation = scene::rotation_of(*base);
    const double down = degrees(scanout::atan2(rotation[1].z, rotation[1].y)) *
                        scene::kAngleUnitsPerDegree; // of the camera on the orbit
    scene::Flight& flight = state_.look.flight;
    flight.azimuth = scene::wrap_angle(from.azimuth + left);
    const double lifted = static_cast<double>(from.elevation + up);
    flight.elevation = static_cast<int>(std::clamp(lifted, down - kSteepest, down + kSteepest));
}

// What is seen follows the hand.
void Viewer::drag_flight(const Action& action, const geom::Mesh& mesh) {
    const scene::Flight& from = drag_->start.flight;
    const auto [dx, dy, unused] = action.numbers;
    if (action.id == ActionId::drag_rotate)
        return look_by(angle_of_pixels(dx) / kLookShare, angle_of_pixels(dy) / kLookShare, from,
                       mesh);
    if (action.id == ActionId::drag_roll) return;
    const double units = drag_->units_per_pixel * scene::kPanUnitsPerRadius;
    state_.look.flight = from;
    if (action.id == ActionId::drag_move)
        fly_by({-units * dx, units * dy, 0}, mesh);
    else
        fly_by({0, 0, units * dy}, mesh);
}

} // namespace scanout::app
