// D: the hazards of the model one after the other; the view flies to the worst place of each.
#include "app/view/viewer.h"
#include "math/transcendental.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scanout::app {
namespace {

constexpr int kCloseUp = 3 * scene::kZoomLevelsPerOctave;

int angle_units(double radians) {
    constexpr double kUnits = scene::kFullTurn / (2 * 3.14159265358979323846);
    return scene::wrap_angle(static_cast<std::int64_t>(std::floor(radians * kUnits + 0.5)));
}

} // namespace

void Viewer::set_hazards(std::vector<std::optional<HazardSpot>> places) {
    hazards_ = std::move(places);
}

// The panel opens also where there is no hazard, and says so.
void Viewer::next_hazard(const geom::Mesh* mesh) {
    const int last = std::max(static_cast<int>(hazards_.size()), 1);
    state_.doctor = state_.doctor < last ? state_.doctor + 1 : 0;
    state_.explain = state_.warnings = 0; // it takes the room of the plan
    if (mesh == nullptr || state_.doctor == 0 || hazards_.empty()) return;
    const std::optional<HazardSpot>& spot = hazards_[static_cast<std::size_t>(state_.doctor - 1)];
    if (!spot) return;
    const Look before = state_.look;
    fly_to(*spot, *mesh);
    if (!(state_.look == before)) remember(before);
}

std::optional<DVec3> Viewer::hazard_place() const {
    if (state_.doctor == 0 || hazards_.empty()) return std::nullopt;
    const std::optional<HazardSpot>& spot = hazards_[static_cast<std::size_t>(state_.doctor - 1)];
    return spot ? std::optional(spot->at) : std::nullopt;
}

// The surface's front at the place turns to the eye, or the side of the model on which the place
// lies; then the place comes to where the camera looks, large.
void Viewer::fly_to(const HazardSpot& spot, const geom::Mesh& mesh) {
    const Look before = state_.look;
    look_from(0);
    Look& look = state_.look;
    look.turntable = look.plays = false;
    look.pose = {};
    look.orbit = {};
    const DVec3 from_centre = scene::radii_from_centre(mesh, spot.at) * mesh.radius;
    const Result<scene::View> front = view(mesh);
    if (!front) {
        state_.look = before;
        return;
    }
    const bool has_normal = dot3(spot.normal, spot.normal) > 0;
    const DVec3 side = has_normal ? front->normal * spot.normal : front->linear * from_centre;
    const double flat = std::sqrt(side.x * side.x + side.z * side.z);
    if (flat > 0 || side.y != 0) {
        look.pose.yaw = flat > 0 ? angle_units(-scanout::atan2(side.x, side.z)) : 0;
        look.pose.pitch = angle_units(scanout::atan2(side.y, flat));
    }
    look.pose.zoom = kCloseUp;
    const Result<scene::View> turned = view(mesh);
    if (!turned) {
        state_.look = before;
        return;
    }
    const DVec3 seen = turned->linear * from_centre + turned->translation;
    const double distance = turned->target_distance;
    look.pose.pan_x = moved(0, -seen.x * scene::kPanUnitsPerRadius);
    look.pose.pan_y = moved(0, -seen.y * scene::kPanUnitsPerRadius);
    look.pose.pan_z = moved(0, (-distance - seen.z) * scene::kPanUnitsPerRadius);
}

// The pixel of a place in file coordinates; nothing where it is not in the picture.
std::optional<PixelPlace> Viewer::pixel_of(const DVec3& place, const geom::Mesh& mesh) const {
    const Result<scene::View> now = view(mesh);
    if (!now) return std::nullopt;
    const DVec3 seen = scene::in_view(place, *now, mesh);
    if (now->projection == scene::Projection::perspective && !(seen.z < 0)) return std::nullopt;
    const DVec2 at = scene::picture_point(*now, seen, width_, height_);
    if (!(at.x >= 0 && at.x < width_ && at.y >= 0 && at.y < height_)) return std::nullopt;
    return PixelPlace{static_cast<int>(at.x), static_cast<int>(at.y)};
}

} // namespace scanout::app
