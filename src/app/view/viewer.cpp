#include "app/view/viewer.h"

#include "base/check.h"
#include "frame/catalogue.h"
#include "frame/plan/plan.h"
#include "scene/fit.h"

#include <algorithm>
#include <utility>

namespace scanout::app {
namespace {

constexpr int kRotateStep = 5 * scene::kAngleUnitsPerDegree;
constexpr std::int64_t kMoveStep = scene::kPanUnitsPerRadius / 16;
constexpr int kClickPixels = 2; // a hand that clicks does not stand still
constexpr int kSlideStep = 8;   // levels: fifty steps go through the model
constexpr int kZoomStep = 8;    // levels: eight steps double the size
constexpr std::size_t kHistory = 256;

// The page after this one; after the last one, none.
int next_page(int page, int pages) {
    return page < pages ? page + 1 : 0;
}

scene::UpAxis next_axis(scene::UpAxis up) {
    using enum scene::UpAxis;
    constexpr std::array kCycle = {plus_y, plus_z, plus_x, minus_y, minus_z, minus_x};
    const auto here = std::find(kCycle.begin(), kCycle.end(), up) - kCycle.begin();
    return kCycle[static_cast<std::size_t>(here + 1) % kCycle.size()];
}

// What the file says comes first.
frame::Cull next_culling(frame::Cull cull) {
    using enum frame::Cull;
    return cull == material ? back : cull == back ? front : cull == front ? none : material;
}

// The technique after this one on its axis, in the order of techniques.h.
std::string next_on(std::string_view axis, std::string_view now) {
    const std::vector<std::string_view> names = frame::names_on(axis);
    const auto here = std::find(names.begin(), names.end(), now);
    return std::string(here == names.end() || here + 1 == names.end() ? names[0] : here[1]);
}

// Neither moved nor zoomed.
scene::Pose turned_alone(const scene::Pose& pose) {
    scene::Pose turned;
    turned.yaw = pose.yaw;
    turned.pitch = pose.pitch;
    turned.roll = pose.roll;
    return turned;
}
scene::Orbit turned_alone(const scene::Orbit& orbit) {
    scene::Orbit turned;
    turned.azimuth = orbit.azimuth;
    turned.elevation = orbit.elevation;
    turned.roll = orbit.roll;
    return turned;
}

} // namespace

Viewer::Viewer(const Settings& settings, int width, int height, int files)
    : model_(settings.model), camera_(settings.camera), lights_(settings.frame.lights),
      motion_(settings.motion), motion_start_(settings.time.value_or(0)), width_(width),
      height_(height), files_(files), inertia_(settings.inertia) {
    if (motion_) {
        of_model_ = motion_->without_camera();
        start_.plays = !settings.time;
    }
    start_.projection = camera_.projection;
    start_.up = camera_.up;
    start_.cull = settings.frame.cull;
    if (!frame::is_auto(settings.frame.colour_by)) start_.colour_by = settings.frame.colour_by;
    start_.annotations = settings.frame.annotations;
    start_.section = settings.section;
    if (!frame::is_auto(settings.frame.edges)) start_.edges = settings.frame.edges;
    state_.measuring = !settings.measured.empty();
    for (const DVec3& point : settings.measured)
        take_point(point);
    start_.rendering = rendering_of(settings.frame);
    CHECK(lights_.size() <= start_.lights.size()); // add_light() takes no more
    state_.look = start_;
    state_.pointer.x = width / 2;
    state_.pointer.y = height / 2;
    state_.split_x = width / 2;
}

void Viewer::resize(int width, int height) {
    const auto moved = [](int at, int before, int after) {
        return static_cast<int>(std::int64_t{at} * after / before);
    };
    state_.pointer.x = std::min(moved(state_.pointer.x, width_, width), width - 1);
    state_.pointer.y = std::min(moved(state_.pointer.y, height_, height), height - 1);
    state_.split_x = moved(state_.split_x, width_, width);
    width_ = width;
    height_ = height;
    drag_.reset();
    fits_.clear();
}

void Viewer::take_up_of_file(scene::UpAxis up) {
    if (state_.look.up == start_.up) state_.look.up = up;
    start_.up = up;
}

void Viewer::take_file(bool again) {
    fits_.clear();
    if (again) return;
    state_.look.flight = {};
    state_.look.flies = false;
    state_.look.stretch = {};
    state_.look.pose = turned_alone(state_.look.pose);
    state_.look.orbit = turned_alone(state_.look.orbit);
}

scene::CameraOptions Viewer::camera() const {
    scene::CameraOptions camera = camera_;
    camera.projection = state_.look.projection;
    camera.up = state_.look.up;
    if (state_.look.view < 0) return camera;
    const ViewAngles& angles = view_angles(state_.look.view);
    return scene::fitted_from(angles.azimuth_degrees, angles.elevation_degrees, camera);
}

const scene::CameraOptions& Viewer::fitted_camera(const geom::Mesh& mesh) const {
    const FitKey key{state_.look.view, state_.look.projection, state_.look.up};
    const auto known =
        std::find_if(fits_.begin(), fits_.end(), [&](const Fit& fit) { return fit.key == key; });
    if (known != fits_.end()) return known->camera;
    const double aspect = static_cast<double>(width_) / height_;
    fits_.push_back({key, motion() != nullptr
                              ? scene::fitted(mesh, model_, camera(), aspect, *motion())
                              : scene::fitted(mesh, model_, camera(), aspect)});
    return fits_.back().camera;
}

Result<scene::View> Viewer::view(const geom::Mesh& mesh) const {
    const Moment now = moment(mesh);
    return scene::make_view(mesh, now.model, state_.look.pose, now.camera, state_.look.orbit,
                            width_, height_, state_.look.flight);
}

Effect Viewer::apply(const Action& action, const geom::Mesh* mesh) {
    answer_.clear();
    const Effect effect = carry_out(action, mesh);
    if (answer_.empty()) answer_ = change_text(action.id, state_);
    return effect;
}

// One thing that is open or under way, in a fixed order; quits where there is none.
Effect Viewer::close_topmost(const geom::Mesh* mesh) {
    if (state_.help > 0)
        state_.help = 0;
    else if (moves_light())
        state_.light = -1;
    else if (state_.measuring)
        stop_measuring();
    else if (state_.look.flies)
        return carry_out({ActionId::toggle_fly, {}, {}, false}, mesh);
    else if (state_.explain > 0)
        state_.explain = 0;
    else if (state_.warnings > 0)
        state_.warnings = 0;
    else if (state_.frontier)
        state_.frontier = false;
    else if (state_.doctor > 0)
        state_.doctor = 0;
    else if (state_.split)
        state_.split = false;
    else if (state_.error_map)
        state_.error_map = false;
    else if (state_.info)
        state_.info = false;
    else
        return Effect::quit;
    return Effect::none;
}

Effect Viewer::carry_out(const Action& action, const geom::Mesh* mesh) {
    stop_spin(action.id);
    switch (action.id) {
    case ActionId::previous_file:
        return change_file(-1);
    case ActionId::next_file:
        return change_file(1);
    case ActionId::toggle_drive:
        state_.camera_mode = !state_.camera_mode;
        return Effect::none;
    case ActionId::scale_axis_next:
        state_.scale_axis = state_.scale_axis < 2 ? state_.scale_axis + 1 : -1;
        return Effect::none;
    case ActionId::toggle_info:
        state_.info = !state_.info;
        return Effect::none;
    case ActionId::toggle_explain:
        state_.explain = next_page(state_.explain, pages_.explain);
        state_.doctor = state_.warnings = 0;
        return Effect::none;
    case ActionId::toggle_warnings:
        state_.warnings = next_page(state_.warnings, pages_.warnings);
        state_.doctor = state_.explain = 0;
        return Effect::none;
    case ActionId::toggle_doctor:
        next_hazard(mesh);
        return Effect::none;
    case ActionId::toggle_error_map:
        state_.error_map = !state_.error_map;
        return Effect::none;
    case ActionId::rung_down:
        state_.frontier = true;
        state_.look.rendering.over_rungs = 0; // what is touched last counts
        return Effect::rung_down;
    case ActionId::rung_up:
        state_.frontier = true;
        state_.look.rendering.over_rungs = 0;
        return Effect::rung_up;
    case ActionId::toggle_split:
        state_.split = !state_.split;
        return Effect::none;
    case ActionId::split_left:
        put_split(state_.split_x - split_step());
        return Effect::none;
    case ActionId::split_right:
        put_split(state_.split_x + split_step());
        return Effect::none;
    case ActionId::toggle_help:
        state_.help = next_page(state_.help, pages_.help);
        return Effect::none;
    case ActionId::light_next:
        next_light();
        return Effect::none;
    case ActionId::close:
        return close_topmost(mesh);
    case ActionId::undo:
        undo();
        return Effect::none;
    case ActionId::pointer:
        state_.pointer = {std::clamp(action.numbers[0], 0, width_ - 1),
                          std::clamp(action.numbers[1], 0, height_ - 1), true,
                          step_ + kPointerSteps};
        return Effect::none;
    case ActionId::drag_begin:
        begin_drag(mesh);
        return Effect::none;
    case ActionId::drag_rotate:
    case ActionId::drag_move:
    case ActionId::drag_roll:
    case ActionId::drag_zoom:
        drag(action, mesh);
        return Effect::none;
    case ActionId::drag_end: {
        const bool click = drag_ && !drag_->split_x && drag_->farthest <= kClickPixels;
        throw_off();
        drag_.reset();
        return click && state_.measuring ? Effect::pick : Effect::none;
    }
    case ActionId::toggle_measuring:
        if (state_.measuring)
            stop_measuring();
        else
            state_.measuring = true;
        return Effect::none;
    case ActionId::reload:
        state_.doctor = 0;
        return Effect::reload;
    case ActionId::screenshot:
        return Effect::screenshot;
    case ActionId::print_view:
        return Effect::print_view;
    case ActionId::frame:
        return Effect::frame;
    case ActionId::suspend:
        return Effect::suspend;
    case ActionId::quit:
        return Effect::quit;
    default:
        break;
    }
    const Look before = state_.look;
    const bool switched = switch_rendering(action.id);
    if (!switched && !fly(action, mesh)) change_look(action, mesh);
    if (!action.repeated && !(state_.look == before)) remember(before);
    return switched ? Effect::rendering : Effect::none;
}

void Viewer::stop_measuring() {
    state_.measuring = false;
    state_.measured_count = 0;
}

void Viewer::take_point(const DVec3& file_coordinates) {
    if (state_.measured_count == 3) state_.measured_count = 0;
    state_.measured[static_cast<std::size_t>(state_.measured_count++)] = file_coordinates;
}

// Opens the split view where it is not.
void Viewer::put_split(std::int64_t x) {
    state_.split_x = static_cast<int>(std::clamp<std::int64_t>(x, 0, width_));
    state_.split = true;
}

void Viewer::change_look(const Action& action, const geom::Mesh* mesh) {
    Look& look = state_.look;
    int& roll = state_.camera_mode ? look.orbit.roll : look.pose.roll;
    switch (action.id) {
    case ActionId::rotate_left:
        return rotate(-kRotateStep, 0, mesh);
    case ActionId::rotate_right:
        return rotate(kRotateStep, 0, mesh);
    case ActionId::rotate_up:
        return rotate(0, kRotateStep, mesh);
    case ActionId::rotate_down:
        return rotate(0, -kRotateStep, mesh);
    case ActionId::move_left:
        return move(-kMoveStep, 0);
    case ActionId::move_right:
        return move(kMoveStep, 0);
    case ActionId::move_up:
        return move(0, kMoveStep);
    case ActionId::move_down:
        return move(0, -kMoveStep);
    case ActionId::scale_up:
        return moves_light() ? brighten(kZoomStep) : scale(kZoomStep);
    case ActionId::scale_down:
        return moves_light() ? brighten(-kZoomStep) : scale(-kZoomStep);
    case ActionId::move_far:
        return move_in_depth(-kMoveStep);
    case ActionId::move_near:
        return move_in_depth(kMoveStep);
    case ActionId::roll_left:
        roll = scene::wrap_angle(roll + kRotateStep);
        return;
    case ActionId::roll_right:
        roll = scene::wrap_angle(roll - kRotateStep);
        return;
    case ActionId::zoom_at:
        return zoom_at(action.numbers[0], action.numbers[1], action.numbers[2], mesh);
    case ActionId::reset:
        look = start_;
        return;
    case ActionId::fit:
        return fit(mesh);
    case ActionId::toggle_projection:
        look.projection = look.projection == scene::Projection::perspective
                              ? scene::Projection::orthographic
                              : scene::Projection::perspective;
        return;
    case ActionId::up_axis_next:
        look.up = next_axis(look.up);
        return;
    case ActionId::cull_next:
        look.cull = next_culling(look.cull);
        return;
    case ActionId::colour_next:
        look.colour_by = next_on("colour_by", look.colour_by);
        return;
    case ActionId::section_next:
        return next_section();
    case ActionId::section_flip:
        return flip_section();
    case ActionId::section_down:
        return slide_section(-kSlideStep, mesh);
    case ActionId::section_up:
        return slide_section(kSlideStep, mesh);
    case ActionId::slide_section:
        return slide_section(action.numbers[0], mesh);
    case ActionId::edges_next:
        look.edges = next_on("edges", look.edges);
        return;
    case ActionId::toggle_points:
    case ActionId::toggle_normals:
    case ActionId::toggle_box:
    case ActionId::toggle_grid:
    case ActionId::toggle_axes:
        return toggle(static_cast<frame::Annotation>(static_cast<int>(action.id) -
                                                     static_cast<int>(ActionId::toggle_points)),
                      mesh);
    case ActionId::toggle_turntable:
        if (motion_) return toggle_playing();
        look.turntable = !look.turntable;
        return;
    default:
        break;
    }
    if (is_view(action.id))
        look_from(static_cast<int>(action.id) - static_cast<int>(ActionId::view_front));
}

// The lengths that it shows are said with it.
void Viewer::toggle(frame::Annotation annotation, const geom::Mesh* mesh) {
    state_.look.annotations.toggle(annotation);
    if (mesh == nullptr || !state_.look.annotations.has(annotation)) return;
    const std::string size = frame::size_text(annotation, mesh->box_max - mesh->box_min);
    if (!size.empty())
        answer_ = fmt::format("{}: {}",
                              frame::kAnnotationNames[static_cast<std::size_t>(annotation)], size);
}

// What turntable and motion have done since then is nobody's action, and stays.
void Viewer::undo() {
    if (history_.empty()) {
        answer_ = "nothing to undo";
        return;
    }
    const Remembered& last = history_.back();
    const std::int64_t played = state_.look.motion_steps;
    state_.look = last.look;
    state_.look.motion_steps = played;
    scene::Pose& pose = state_.look.pose;
    pose.yaw = scene::wrap_angle(pose.yaw + (turned_ - last.turned));
    history_.pop_back();
}

void Viewer::remember(const Look& before) {
    history_.push_back({before, turned_});
    if (history_.size() > kHistory) history_.pop_front();
}

Effect Viewer::change_file(int by) {
    if (files_ < 2) {
        answer_ = "there is one file only";
        return Effect::none;
    }
    state_.file = (state_.file + by + files_) % files_;
    state_.doctor = state_.warnings = 0;
    state_.measured_count = 0; // points of the model before
    return Effect::load_file;
}

void Viewer::advance_to(std::int64_t step) {
    if (step <= step_) return;
    const std::int64_t passed = std::exchange(step_, step);
    for (std::int64_t i = 0; i < step - passed && spins(); ++i)
        spin();
    scene::Pose& pose = state_.look.pose;
    if (turntable_turns()) {
        const std::int64_t turn = (step - passed) * kTurntableUnitsPerStep;
        pose.yaw = scene::wrap_angle(pose.yaw + turn);
        turned_ += turn;
    }
    if (state_.look.plays) play(step - passed);
    if (step >= state_.pointer.hide_step) state_.pointer.visible = false;
}

std::int64_t Viewer::next_step() const {
    return turning() || follows_hand() ? step_ + 1 : state_.pointer.hide_step;
}

} // namespace scanout::app
