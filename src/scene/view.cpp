#include "scene/view.h"

#include "math/bits.h"
#include "math/rotation.h"
#include "math/transcendental.h"
#include "scene/largest_entry.h"
#include "scene/placement.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace scanout::scene {
namespace {

bool finite(const DVec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Of finite vectors of any size: squares alone would leave the range of a double. A power of two
// changes no bit.
double length(const DVec3& v) {
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (largest == 0) return 0;
    const int exponent = decompose(largest).exponent;
    DVec3 unit;
    for (int axis = 0; axis < 3; ++axis)
        unit[axis] = scanout::scale(v[axis], -exponent);
    return scanout::scale(scanout::sqrt(dot3(unit, unit)), exponent);
}

// Where the camera stands before the user's orbit: angles in degrees, distance and target in radii.
struct Stand {
    double azimuth = 0, elevation = 0, distance = 0;
    DVec3 target{0};
};

Result<Stand> stand_of(const geom::Mesh& mesh, const CameraOptions& camera, const DMat3& up,
                       double fit_distance) {
    Stand stand;
    if (!camera.eye && !camera.target) {
        stand.azimuth = camera.azimuth_degrees;
        stand.elevation = camera.elevation_degrees;
        stand.distance = camera.distance > 0 ? camera.distance : fit_distance;
        if (camera.pivot) stand.target = up * radii_from_centre(mesh, *camera.pivot);
        return stand;
    }
    if (!camera.eye || !camera.target)
        return fail(Exit::usage, "a camera's eye and target belong together: give both or neither");
    const DVec3 eye = up * radii_from_centre(mesh, *camera.eye);
    stand.target = up * radii_from_centre(mesh, *camera.target);
    const DVec3 back = eye - stand.target;
    if (!finite(back)) return fail(Exit::usage, "the camera's eye and target must be finite");
    stand.distance = length(back);
    if (stand.distance == 0)
        return fail(Exit::usage,
                    "the camera's eye and target are the same point, or too close together for a "
                    "model of this size; move one of them");
    stand.azimuth = degrees(scanout::atan2(back.x, back.z));
    stand.elevation = degrees(scanout::atan2(back.y, length({back.x, 0, back.z})));
    return stand;
}

DVec3 pan_of(std::int64_t x, std::int64_t y, std::int64_t z) {
    return DVec3(static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)) /
           static_cast<double>(kPanUnitsPerRadius);
}

double units_to_degrees(int units) {
    return static_cast<double>(units) / kAngleUnitsPerDegree;
}

// The cofactor matrix with the sign of a proper rotation, brought to a largest entry of 1: products
// of entries neither overflow nor vanish, and floats can hold the result.
void set_normal_matrix(View& view) {
    const double size = largest_entry(view.linear);
    const DMat3 unit = size > 0 ? view.linear / size : DMat3(0);
    const DMat3 normal = cofactor(unit);
    const double largest = largest_entry(normal);
    view.mirrored = determinant(unit) < 0;
    if (!(largest > 0)) return; // a model scaled to a line or point: any normal will do
    view.normal = normal / (view.mirrored ? -largest : largest);
}

void set_extent(View& view, const CameraOptions& camera, double tan_half, double aspect,
                double distance, double zoom) {
    const bool perspective = camera.projection == Projection::perspective;
    if (camera.window) {
        const Window& w = *camera.window;
        const double unit = perspective ? 1 / camera.near.value_or(1) : 1 / zoom;
        view.half_width = (w.right - w.left) / 2 * unit;
        view.half_height = (w.top - w.bottom) / 2 * unit;
        view.middle = DVec2(w.left + w.right, w.bottom + w.top) * (unit / 2);
        return;
    }
    const DVec2 half =
        half_extents(perspective ? tan_half : tan_half * distance, camera.screen_fit, aspect);
    view.half_width = half.x;
    view.half_height = half.y;
}

// Orthographic depth between the planes that the caller gives, where they cut the model.
void set_parallel_depth(View& view, double radius) {
    double least = view.translation.z - radius, most = view.translation.z + radius;
    if (-view.cut_near > least) most = std::min(most, -view.cut_near);
    if (-view.cut_far < most) least = std::max(least, -view.cut_far);
    view.depth_origin = least;
    view.depth_scale = 1 / (most - least);
}

void set_projection(View& view, const CameraOptions& camera, double distance, double radius) {
    view.projection = camera.projection;
    view.centre_distance = -view.translation.z;
    const bool perspective = camera.projection == Projection::perspective;
    // Reversed, infinite: depth = near / distance keeps its relative precision everywhere, so near
    // may be small. It is a fixed share of the way to what is looked at, or to the end of the model
    // where that is nearer: a target far behind the model cuts nothing off.
    view.target_distance = distance;
    view.near_distance = std::min(distance, length(view.translation) + radius) * 0x1p-14;
    if (camera.near) (perspective ? view.near_distance : view.cut_near) = *camera.near;
    if (camera.far) view.cut_far = *camera.far;
    // Without perspective it changes nothing how far away the model stands; from very far its own
    // depth would be lost in the sum.
    const bool cuts = camera.near || camera.far;
    if (!perspective && !cuts && std::abs(view.translation.z) > radius * 0x1p20) {
        view.world_origin.z -= view.translation.z;
        view.translation.z = 0;
    }
    view.depth_origin = view.translation.z - radius;
    view.depth_scale = 1 / (2 * radius);
    if (!perspective && cuts) set_parallel_depth(view, radius);
}

Result<void> check_cuts(const CameraOptions& camera) {
    const bool perspective = camera.projection == Projection::perspective;
    if (camera.near && perspective && !(*camera.near > 0))
        return fail(Exit::usage,
                    "the near plane must lie before the eye: give a distance above 0, not {}",
                    *camera.near);
    constexpr double kEverywhere = -std::numeric_limits<double>::infinity();
    if (camera.far && !(*camera.far > camera.near.value_or(perspective ? 0 : kEverywhere)))
        return fail(Exit::usage, "the far plane must lie beyond {}, not at {}",
                    camera.near ? fmt::format("the near plane, {}", *camera.near) : "the eye",
                    *camera.far);
    if (const auto& w = camera.window; w && !(w->left < w->right && w->bottom < w->top))
        return fail(Exit::usage,
                    "left must be below right and bottom below top: {} to {}, {} to {}", w->left,
                    w->right, w->bottom, w->top);
    return {};
}

// Whether all that is made of the view stays a number: floats hold depth, at most this small, and
// doubles products of three coordinates.
Result<void> check_ratios(const View& view, double distance, double radius) {
    constexpr double kLeast = 0x1p-120;
    const double far = std::max(view.centre_distance, 0.0) + radius;
    const bool fits = view.projection == Projection::perspective
                          ? view.near_distance >= far * kLeast
                          : view.half_height >= radius * kLeast;
    if (fits) return {};
    return fail(Exit::usage,
                "a camera {} bounding radii from its target is too close for a model that reaches "
                "{}; give it a larger distance or the model a smaller scale",
                distance, far);
}

double largest_length(const View& view) {
    const DVec3& t = view.translation;
    return std::max({largest_entry(view.linear), std::abs(t.x), std::abs(t.y), std::abs(t.z)});
}

Result<void> check_size(const View& view, double distance) {
    const double size = std::max(largest_length(view), distance);
    if (!finite(view.linear[0]) || !finite(view.linear[1]) || !finite(view.linear[2]) ||
        !finite(view.translation) || !std::isfinite(distance) || size > 0x1p900 || size < 0x1p-900)
        return fail(Exit::usage,
                    "the camera or the model's transform leads to numbers that are too large, too "
                    "small or not finite; give more moderate ones");
    return {};
}

} // namespace

// Turns the file's up axis onto +y; the front then is the +z side (of +z up: the -y side).
std::string_view name_of(UpAxis up) {
    constexpr std::array<std::string_view, 6> kNames = {"y", "-y", "z", "-z", "x", "-x"};
    return kNames[static_cast<std::size_t>(up)];
}

DMat3 up_rotation(UpAxis up) {
    switch (up) {
    case UpAxis::plus_y:
        return DMat3(1);
    case UpAxis::minus_y:
        return rotation_x(180);
    case UpAxis::plus_z:
        return rotation_x(-90);
    case UpAxis::minus_z:
        return rotation_x(90);
    case UpAxis::plus_x:
        return rotation_z(90);
    case UpAxis::minus_x:
        return rotation_z(-90);
    }
    return DMat3(1);
}

DMat3 turned(const DMat3& to_view, const ModelTransform& model) {
    return model.turn ? to_view * *model.turn : to_view;
}

DVec3 radii_from_centre(const geom::Mesh& mesh, const DVec3& file) {
    DVec3 normalised = file - mesh.centre;
    for (int axis = 0; axis < 3; ++axis)
        normalised[axis] = scanout::scale(normalised[axis], -mesh.exponent);
    return normalised / mesh.radius;
}

double radii_per_unit(const geom::Mesh& mesh) {
    return scanout::scale(1.0, -mesh.exponent) / mesh.radius;
}

CameraOptions fitted_from(double azimuth_degrees, double elevation_degrees, CameraOptions camera) {
    camera.azimuth_degrees = azimuth_degrees;
    camera.elevation_degrees = elevation_degrees;
    camera.distance = 0;
    camera.shift = DVec2(0);
    camera.eye.reset();
    camera.target.reset();
    return camera;
}

std::optional<NamedView> named_view(std::string_view name) {
    static constexpr std::array<NamedView, 7> kViews = {
        {{"front", 0, 0},
         {"back", 180, 0},
         {"left", 270, 0},
         {"right", 90, 0},
         {"top", 0, 90},
         {"bottom", 0, -90},
         // atan(1 / sqrt 2): all three axes equally long
         {"iso", 45, 35.264389682754654}}};
    const auto found = std::find_if(kViews.begin(), kViews.end(),
                                    [&](const NamedView& v) { return v.name == name; });
    return found == kViews.end() ? std::nullopt : std::optional(*found);
}

Result<View> make_view(const geom::Mesh& mesh, const ModelTransform& model, const Pose& pose,
                       const CameraOptions& given, const Orbit& orbit, int width, int height,
                       const Flight& flight) {
    CameraOptions camera = given;
    if (camera.window && camera.window->projection != camera.projection) { // of the other one
        camera.window.reset();
        camera.near.reset();
        camera.far.reset();
    }
    if (!(camera.distance >= 0))
        return fail(Exit::usage, "the camera's distance must be positive, not {}", camera.distance);
    if (!(camera.fov_degrees > 0) || !(camera.fov_degrees < 180))
        return fail(Exit::usage, "the field of view must lie between 0 and 180 degrees, not {}",
                    camera.fov_degrees);
    TRY_VOID(check_cuts(camera));
    const double aspect = static_cast<double>(width) / height;
    const double half_fov = camera.fov_degrees / 2;
    const double tan_half = sin_degrees(half_fov) / cos_degrees(half_fov);
    const DVec2 extents = half_extents(tan_half, camera.screen_fit, aspect);
    const double narrow = std::min(extents.x, extents.y);
    const double fit_distance = scanout::sqrt(1 + narrow * narrow) / narrow; // 1 / sin(half angle)

    const DMat3 up = up_rotation(camera.up);
    TRY(const Stand stand, stand_of(mesh, camera, up, fit_distance));
    const double elevation =
        std::clamp(stand.elevation + units_to_degrees(orbit.elevation), -90.0, 90.0);
    const DMat3 rotation =
        rotation_z(units_to_degrees(orbit.roll)) * rotation_x(elevation) *
        rotation_y(-(stand.azimuth + units_to_degrees(orbit.azimuth))); // world -> view
    const double distance = stand.distance / zoom_scale(orbit.zoom);

    const Placement placed = placement_of(model, mesh, camera.up);
    const DMat3 posed = rotation_z(units_to_degrees(pose.roll)) *
                        rotation_x(units_to_degrees(pose.pitch)) * rotation *
                        rotation_y(units_to_degrees(pose.yaw));
    const DVec3 shift(camera.shift.x, camera.shift.y, 0);
    View view;
    view.linear = turned(posed, model) * placed.linear * up * (zoom_scale(pose.zoom) / mesh.radius);
    view.translation =
        rotation * (placed.offset - stand.target) + pan_of(pose.pan_x, pose.pan_y, pose.pan_z) -
        pan_of(orbit.pan_x, orbit.pan_y, orbit.pan_z) - shift - DVec3(0, 0, distance);
    view.up = camera.up;
    view.world_axes = rotation * up;
    view.world_origin = rotation * -stand.target - pan_of(orbit.pan_x, orbit.pan_y, orbit.pan_z) -
                        shift - DVec3(0, 0, distance);
    if (!(flight == Flight())) {
        const DMat3 turn = turn_of(flight, rotation);
        const DVec3 eye = pan_of(flight.x, flight.y, flight.z);
        view.linear = turn * view.linear;
        view.translation = turn * (view.translation - eye);
        view.world_axes = turn * view.world_axes;
        view.world_origin = turn * (view.world_origin - eye);
    }
    TRY_VOID(check_size(view, distance));
    set_normal_matrix(view);
    // The model's sphere in view space lies within `radius` of its centre: |linear p| <= 3 max |p|.
    const double largest = largest_entry(view.linear);
    const double radius =
        largest * 3.001 + (largest > 0 ? std::min(largest * 0x1p-10, 0x1p-20) : 0x1p-20);
    set_extent(view, camera, tan_half, aspect, distance, zoom_scale(orbit.zoom));
    set_projection(view, camera, distance, radius);
    TRY_VOID(check_ratios(view, distance, radius));
    return view;
}

DMat3 turn_of(const Flight& flight, const DMat3& rotation) {
    // About the world's up axis, as the camera on the orbit sees it.
    return rotation_x(-units_to_degrees(flight.elevation)) *
           rotation_about(rotation[1], -units_to_degrees(flight.azimuth));
}

double to_floats(const View& view) {
    const double largest = largest_length(view);
    return largest < 0x1p40 ? 1.0 : scanout::scale(0x1p40, -decompose(largest).exponent);
}

DVec2 half_extents(double half, ScreenFit fit, double aspect) {
    return {fit == ScreenFit::height ? half * aspect : half,
            fit == ScreenFit::width ? half / aspect : half};
}

DVec3 in_view(const DVec3& file_place, const View& view, const geom::Mesh& mesh) {
    return view.linear * (radii_from_centre(mesh, file_place) * mesh.radius) + view.translation;
}

DVec2 picture_point(const View& view, const DVec3& seen, int width, int height) {
    const double distance = view.projection == Projection::perspective ? -seen.z : 1;
    const double x = seen.x - distance * view.middle.x, y = seen.y - distance * view.middle.y;
    return {(x / (distance * view.half_width) + 1) / 2 * width,
            (1 - y / (distance * view.half_height)) / 2 * height};
}

double world_units_per_pixel(const View& view, int height) {
    const double extent =
        view.projection == Projection::perspective
            ? view.half_height * std::max(view.centre_distance, view.near_distance)
            : view.half_height;
    return 2 * extent / height;
}

} // namespace scanout::scene
