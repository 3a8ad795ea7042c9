#include "app/view/view_command.h"

#include "app/options/options.h"
#include "math/transcendental.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

namespace scanout::app {
namespace {

constexpr double kDegrees = 180 / 3.14159265358979323846;

// Ten digits are finer than any picture; smaller rounding errors become 0.
std::string number(double value) {
    return std::abs(value) < 1e-10 ? "0" : fmt::format("{:.10g}", value);
}

std::string triple(const DVec3& v) {
    return fmt::format("{},{},{}", number(v.x), number(v.y), number(v.z));
}

std::string quoted(const std::string& word) {
    constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./,+-:=";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
    std::string text = "'";
    for (const char c : word)
        text += c == '\'' ? "'\\''" : std::string(1, c);
    return text + "'";
}

bool says_the_view(std::string_view option) {
    constexpr std::array<std::string_view, 17> kWritten = {
        "size",    "cull",        "colour-by", "edges",     "annotate", "section",
        "measure", "scale",       "rotate",    "translate", "exposure", "background",
        "shear",   "rotate-axis", "matrix",    "about",     "motion"};
    return std::find(kWritten.begin(), kWritten.end(), option) != kWritten.end() ||
           std::find(kSwitchedAxes.begin(), kSwitchedAxes.end(), option) != kSwitchedAxes.end();
}

// What is drawn otherwise than where nobody asks for anything.
std::string rendering_options(const Rendering& rendering) {
    const Rendering plain = rendering_of(Settings().frame);
    std::string text;
    for (std::size_t i = 0; i < kSwitchedAxes.size(); ++i)
        if (!frame::is_auto(rendering.asked[i]))
            text += fmt::format(" --{} {}", frame::option_of(kSwitchedAxes[i]), rendering.asked[i]);
    if (rendering.exposure != plain.exposure)
        text += fmt::format(" --exposure {}", number(rendering.exposure));
    if (!(rendering.background == plain.background))
        text += fmt::format(" --background {}", quoted(background_text(rendering.background)));
    return text;
}

// What the user gave that changes the picture, and that the view's own options do not say.
std::string given_options(const Settings& settings, const Rendering& rendering) {
    static_assert(kSwitchedAxes[1] == "aa");
    const bool names_aa = !frame::is_auto(rendering.asked[1]);
    std::string text;
    for (const GivenOption& given : settings.given) {
        const auto option = std::find_if(options().begin(), options().end(), [&](const Option& o) {
            return o.name == given.name && belongs(o, Command::render);
        });
        if (option == options().end() || says_the_view(option->name)) continue;
        if (option->name == "time" && settings.animation.empty())
            continue;                                        // the view is its moment
        if (option->name == "samples" && names_aa) continue; // two ways to ask for the same
        if (option->group != Group::picture && option->group != Group::model &&
            option->name != "pixel-format")
            continue;
        text += fmt::format("--{} ", given.name);
        if (!std::holds_alternative<Switch>(option->slot)) text += quoted(given.text) + " ";
    }
    return text;
}

// About x, then y, then z, in degrees: m = Rz * Ry * Rx. Columns come first: m[column][row].
DVec3 angles_of(const DMat3& m) {
    const double across = std::sqrt(m[0][0] * m[0][0] + m[0][1] * m[0][1]);
    const double y = scanout::atan2(-m[0][2], across);
    // If the y turn is a right angle, x and z turn about one axis: the angle goes to x, and z is 0.
    if (across < 1e-9) return DVec3(scanout::atan2(-m[2][1], m[1][1]), y, 0) * kDegrees;
    return DVec3(scanout::atan2(m[1][2], m[2][2]), y, scanout::atan2(m[0][1], m[0][0])) * kDegrees;
}

// The model's transform for `placed`, which is rotation times scale. Each scale keeps the sign that
// the command line gave it.
scene::ModelTransform transform_of(const DMat3& placed, const DVec3& given_scale) {
    scene::ModelTransform transform;
    for (int axis = 0; axis < 3; ++axis) {
        const DVec3 &a = placed[axis], &b = placed[(axis + 1) % 3];
        if (std::abs(dot3(a, b)) > 1e-9 * length(a) * length(b)) { // it is sheared
            transform.steps.push_back({placed, DVec3(0), {}});
            return transform;
        }
    }
    DMat3 rotation = placed;
    for (int axis = 0; axis < 3; ++axis) {
        const double size = length(placed[axis]);
        transform.scale[axis] = std::copysign(size, given_scale[axis]);
        rotation[axis] = placed[axis] / transform.scale[axis];
    }
    transform.rotate_degrees = angles_of(rotation);
    return transform;
}

bool is_windowed(const scene::CameraOptions& camera) {
    return camera.window && camera.window->projection == camera.projection;
}

// What the picture shows of what lies before the camera.
std::string extent_options(const scene::View& view, const scene::CameraOptions& camera) {
    const bool perspective = view.projection == scene::Projection::perspective;
    if (is_windowed(camera)) {
        const double unit = perspective ? view.near_distance : 1;
        const DVec2 low = (view.middle - DVec2(view.half_width, view.half_height)) * unit,
                    high = (view.middle + DVec2(view.half_width, view.half_height)) * unit;
        return fmt::format(" --{} {},{},{},{},{},{}", perspective ? "frustum" : "ortho", low.x,
                           high.x, low.y, high.y, camera.near.value_or(0), camera.far.value_or(0));
    }
    std::string text =
        fmt::format(" --projection {}", perspective ? "perspective" : "orthographic");
    if (camera.fov_degrees != scene::CameraOptions().fov_degrees)
        text += fmt::format(" --fov {}", number(camera.fov_degrees));
    if (camera.screen_fit != scene::ScreenFit::height)
        text += camera.screen_fit == scene::ScreenFit::width ? " --screen-fit width"
                                                             : " --screen-fit stretch";
    if (camera.window) return text; // its planes are the other projection's
    if (camera.near) text += fmt::format(" --near {}", *camera.near);
    if (camera.far) text += fmt::format(" --far {}", *camera.far);
    return text;
}

// Of a transform that is one step, a matrix.
std::string model_options(const scene::ModelTransform& model) {
    if (model.steps.empty())
        return fmt::format(" --scale {} --rotate {} --translate {}", triple(model.scale),
                           triple(model.rotate_degrees), triple(model.translate));
    const DMat3& m = model.steps.front().linear;
    std::string text = " --matrix ";
    for (int row = 0; row < 3; ++row)
        text += fmt::format("{},{},{},{},", m[0][row], m[1][row], m[2][row], model.translate[row]);
    return text + "0,0,0,1";
}

// A camera without roll that looks along the present line of sight from beside the world's origin.
scene::CameraOptions camera_of(const scene::View& view, const DMat3& to_view,
                               const scene::CameraOptions& given, scene::UpAxis up) {
    const DVec3 back(to_view[0][2], to_view[1][2], to_view[2][2]); // towards the eye, world
    scene::CameraOptions camera;
    camera.azimuth_degrees = scanout::atan2(back.x, back.z) * kDegrees;
    camera.elevation_degrees =
        std::clamp(scanout::atan2(back.y, std::sqrt(back.x * back.x + back.z * back.z)) * kDegrees,
                   -90.0, 90.0);
    camera.fov_degrees = given.fov_degrees;
    camera.projection = view.projection;
    camera.screen_fit = given.screen_fit;
    camera.window = given.window;
    camera.near = given.near;
    camera.far = given.far;
    camera.up = up;
    const double half_fov = camera.fov_degrees / 2;
    camera.distance = view.projection == scene::Projection::perspective || is_windowed(camera) ||
                              camera.screen_fit != scene::ScreenFit::height
                          ? view.target_distance
                          : view.half_height * cos_degrees(half_fov) / sin_degrees(half_fov);
    camera.shift = DVec2(-view.world_origin.x, -view.world_origin.y); // lamps stay where they are
    return camera;
}

// A camera that flies stands anywhere: it is said by eye and target, in the file's coordinates.
void put_flight(const scene::View& view, const geom::Mesh& mesh, scene::CameraOptions& camera) {
    const DMat3 to_file = transpose(view.world_axes);
    const double unit = 1 / scene::radii_per_unit(mesh);
    const DVec3 eye = to_file * -view.world_origin;
    camera.eye = mesh.centre + eye * unit;
    camera.target = mesh.centre + (eye + to_file * DVec3(0, 0, -view.target_distance)) * unit;
    camera.shift = DVec2(0);
}

std::string place_options(const scene::CameraOptions& camera) {
    const auto exact = [](const DVec3& v) { return fmt::format("{},{},{}", v.x, v.y, v.z); };
    if (camera.eye)
        return fmt::format("--eye {} --look-at {}", exact(*camera.eye), exact(*camera.target));
    return fmt::format("--camera {},{},{}", number(camera.azimuth_degrees),
                       number(camera.elevation_degrees), number(camera.distance));
}

} // namespace

std::string view_options(const Viewer& viewer, const Settings& settings, const geom::Mesh& mesh) {
    const Look& look = viewer.state().look;
    const Result<scene::View> now = viewer.view(mesh);
    if (!now || (settings.motion && settings.motion->has_lights())) return {};
    const DMat3 up = scene::up_rotation(look.up);
    scene::CameraOptions given = settings.camera;
    given.fov_degrees = viewer.fov_degrees(mesh); // a motion may change it
    scene::CameraOptions camera = camera_of(*now, now->world_axes * transpose(up), given, look.up);
    if (look.flies) put_flight(*now, mesh, camera);
    const Result<scene::View> plain =
        scene::make_view(mesh, {}, {}, camera, {}, viewer.width(), viewer.height());
    if (!plain) return {};
    const DMat3 to_world = up * transpose(plain->world_axes); // from view space
    scene::ModelTransform model = transform_of(
        to_world * now->linear * transpose(up) * double{mesh.radius}, settings.model.scale);
    model.translate = look.flies
                          ? to_world * (now->translation - plain->translation)
                          : to_world * (now->translation +
                                        DVec3(camera.shift.x, camera.shift.y, camera.distance));
    std::string text =
        given_options(settings, look.rendering) +
        fmt::format("--size {}x{} {}{} --up {} --cull {}", viewer.width(), viewer.height(),
                    place_options(camera), extent_options(*now, camera), name_of(look.up),
                    name_of(look.cull));
    text += rendering_options(look.rendering);
    if (look.colour_by != "light") text += fmt::format(" --colour-by {}", look.colour_by);
    if (look.edges != "none") text += fmt::format(" --edges {}", look.edges);
    if (!look.annotations.empty())
        text += fmt::format(" --annotate {}", frame::to_string(look.annotations));
    if (look.section) text += fmt::format(" --section {}", scene::to_string(*look.section));
    if (const auto points = viewer.measured(); points.size() > 1) {
        text += " --measure ";
        for (std::size_t i = 0; i < points.size(); ++i)
            text += (i > 0 ? ":" : "") + triple(points[i]);
    }
    if (!look.flies)
        text += fmt::format(" --shift {},{}", number(camera.shift.x), number(camera.shift.y));
    return text + model_options(model);
}

std::string view_command(const std::string& path, const std::string& options) {
    return fmt::format("scanout render {} {} -o view.png", quoted(path), options);
}

} // namespace scanout::app
