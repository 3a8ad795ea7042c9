// The actions of the viewer, by name: nothing else changes its picture. Keys and mouse are bound to
// them, recordings consist of them, and the help sheet lists them.
#pragma once

#include "app/view/viewer_state.h"
#include "base/result.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace scanout::app {

// clang-format off
enum class ActionId : std::uint8_t {
    rotate_left, rotate_right, rotate_up, rotate_down,
    move_left, move_right, move_up, move_down,
    previous_file, next_file,
    scale_up, scale_down,
    roll_left, roll_right,
    reset, fit, toggle_drive,
    view_front, view_back, view_right, view_left, view_top, view_bottom, view_iso, view_iso_back,
    toggle_projection, up_axis_next, cull_next, colour_next,
    section_next, section_flip, section_down, section_up, slide_section, toggle_measuring, edges_next, toggle_points, toggle_normals, toggle_box, toggle_grid, toggle_axes,
    light_next,
    toggle_info, toggle_explain, toggle_doctor, toggle_error_map, rung_down, rung_up, toggle_split, split_left, split_right, toggle_turntable, undo, reload, screenshot, print_view, toggle_help, close, quit, suspend,
    toggle_warnings,
    shading_next, shading_previous, aa_next, aa_previous, texture_next, texture_previous, shadow_next, shadow_previous, tone_next, tone_previous, ambient_occlusion_next, ambient_occlusion_previous,
    exposure_up, exposure_down, background_next, background_previous,
    move_far, move_near, scale_axis_next,
    toggle_fly, fly_forward, fly_left, fly_back, fly_right, fly_up, fly_down,
    drag_begin, drag_rotate, drag_move, drag_roll, drag_zoom, drag_end, zoom_at, pointer,
    frame,
};
// clang-format on

// One row an action.
struct ActionRow {
    ActionId id;
    std::string_view name;  // in recordings
    std::string_view keys;  // default keys, separated by spaces; empty: mouse or recordings only
    std::string_view sheet; // how the help sheet names the keys; empty: on an earlier row's line
    std::string_view help;
    int numbers = 0;      // whole numbers that follow the name in a recording
    bool repeats = false; // the key repeats while it is held
    std::string (*state)(const ViewerState&) = nullptr; // for the help sheet: the present state
    std::string_view changes = {}; // name of the state that it changes; empty: the picture shows it
};

std::span<const ActionRow> action_rows();
const ActionRow& row_of(ActionId id);
bool is_view(ActionId id);
bool is_flying(ActionId id); // its keys are those of the camera that flies
// "projection: orthographic": the state that the action has changed, and its new value. Empty where
// the action is no switch.
std::string change_text(ActionId id, const ViewerState& state);
const ActionRow* find_action(std::string_view name); // null: there is none

struct Action {
    ActionId id{};
    std::array<int, 3> numbers{};
    std::string text;      // frame: the file's name
    bool repeated = false; // made by a held key: undone together with its first press
    friend bool operator==(const Action&, const Action&) = default;
};

// "drag_rotate 120 -33", "repeat rotate_left", "frame a.png": one line of a recording, without the
// step. parse_action reads it back; its error names the fault, not the place.
std::string to_text(const Action& action);
Result<Action> parse_action(std::string_view text);

// The views of the keys 1 3 7 9, by ActionId - view_front: camera angles in degrees.
struct ViewAngles {
    std::string_view name;
    double azimuth_degrees, elevation_degrees;
};
const ViewAngles& view_angles(int view);

std::string_view name_of(scene::Projection projection);
std::string_view name_of(frame::Cull cull);

} // namespace scanout::app
