// F: zooms and centres the model so that it just fits the picture, in its present rotation.
#include "app/view/viewer.h"
#include "scene/fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scanout::app {
namespace {

constexpr int kPasses = 6; // perspective changes as the model moves: each pass comes closer

// The extent of the vertices in the picture: -1 to 1 is from edge to edge.
struct Extent {
    double left = std::numeric_limits<double>::infinity(), right = -left;
    double bottom = left, top = -left;

    double half_size() const { return std::max(right - left, top - bottom) / 2; }
    bool fits() const { return std::max({-left, right, -bottom, top}) <= scene::kFitFill; }
};

// Returns nothing where a vertex is too near to the eye, or where there is none.
std::optional<Extent> extent_of(const geom::Mesh& mesh, const scene::View& view) {
    const bool perspective = view.projection == scene::Projection::perspective;
    Extent extent;
    for (const Vec3& vertex : mesh.position) {
        const DVec3 seen = view.linear * DVec3(vertex.x, vertex.y, vertex.z) + view.translation;
        const double distance = perspective ? -seen.z : 1;
        if (!(distance > view.near_distance)) return std::nullopt;
        const double x = (seen.x / distance - view.middle.x) / view.half_width;
        const double y = (seen.y / distance - view.middle.y) / view.half_height;
        extent.left = std::min(extent.left, x);
        extent.right = std::max(extent.right, x);
        extent.bottom = std::min(extent.bottom, y);
        extent.top = std::max(extent.top, y);
    }
    return std::isfinite(extent.half_size()) ? std::optional(extent) : std::nullopt;
}

// The zoom levels that make an extent of this half size fill the picture.
int levels_to_fill(double half_size) {
    int low = -scene::kMaxZoomLevel, high = scene::kMaxZoomLevel;
    while (low < high) {
        const int middle = low + (high - low + 1) / 2;
        if (scene::zoom_scale(middle) * half_size <= scene::kFitFill)
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

} // namespace

// Zooms and centres by the extent in the present view. Returns false where there is no extent.
bool Viewer::fit_once(const geom::Mesh& mesh) {
    const Result<scene::View> now = view(mesh);
    const std::optional<Extent> extent = now ? extent_of(mesh, *now) : std::nullopt;
    if (!extent) return false;
    const double pixel = scene::world_units_per_pixel(*now, height_);
    const double x = (extent->left + extent->right) / 2 * (width_ * 0.5) * pixel;
    const double y = (extent->bottom + extent->top) / 2 * (height_ * 0.5) * pixel;
    scene::Pose& pose = state_.look.pose;
    pose.pan_x = moved(pose.pan_x, -x * scene::kPanUnitsPerRadius);
    pose.pan_y = moved(pose.pan_y, -y * scene::kPanUnitsPerRadius);
    zoom_model(levels_to_fill(extent->half_size()));
    return true;
}

bool Viewer::fits(const geom::Mesh& mesh) const {
    const Result<scene::View> now = view(mesh);
    const std::optional<Extent> extent = now ? extent_of(mesh, *now) : std::nullopt;
    return extent && extent->fits();
}

void Viewer::zoom_model(int levels) {
    scene::Pose& pose = state_.look.pose;
    pose.zoom = scene::clamp_zoom(std::int64_t{pose.zoom} + levels);
}

void Viewer::fit(const geom::Mesh* mesh) {
    if (mesh == nullptr) return;
    const Look before = state_.look;
    scene::Pose& pose = state_.look.pose;
    scene::Orbit& orbit = state_.look.orbit;
    state_.look.flight = {};
    state_.look.flies = false;
    pose.zoom = orbit.zoom = 0;
    pose.pan_x = pose.pan_y = pose.pan_z = orbit.pan_x = orbit.pan_y = orbit.pan_z = 0;
    constexpr int kTries = 20; // octaves: until the eye is outside of the model
    for (int i = 0; i < kTries && !fit_once(*mesh); ++i)
        zoom_model(-scene::kZoomLevelsPerOctave);
    for (int pass = 1; pass < kPasses; ++pass)
        fit_once(*mesh);
    for (int i = 0; i < scene::kZoomLevelsPerOctave && !fits(*mesh); ++i)
        zoom_model(-1);
    if (fits(*mesh)) return;
    state_.look = before;
    answer_ = "from here no size fits: press R";
}

} // namespace scanout::app
