#include "app/view/actions.h"

#include "app/picture/nearest.h"
#include "app/picture/picture.h"
#include "base/check.h"

#include <charconv>
#include <vector>

namespace scanout::app {
namespace {

using Id = ActionId;
using State = const ViewerState&;

std::string on_off(bool on) {
    return on ? "on" : "off";
}
std::string drive_text(State s) {
    return s.camera_mode ? "camera" : "model";
}
std::string view_text(State s) {
    return s.look.view < 0 ? "" : std::string(view_angles(s.look.view).name);
}
std::string projection_text(State s) {
    return std::string(name_of(s.look.projection));
}
std::string up_text(State s) {
    return std::string(name_of(s.look.up));
}
std::string cull_text(State s) {
    return std::string(name_of(s.look.cull));
}
std::string colour_text(State s) {
    return s.look.colour_by;
}
std::string section_text(State s) {
    return s.look.section ? scene::to_string(*s.look.section) : "none";
}
std::string measuring_text(State s) {
    return s.measuring ? "on: click vertices" : "off";
}
std::string edges_text(State s) {
    return s.look.edges;
}
template <frame::Annotation annotation>
std::string annotation_text(State s) {
    return on_off(s.look.annotations.has(annotation));
}
constexpr auto points_text = annotation_text<frame::Annotation::points>,
               normals_text = annotation_text<frame::Annotation::normals>,
               box_text = annotation_text<frame::Annotation::box>,
               grid_text = annotation_text<frame::Annotation::grid>,
               axes_text = annotation_text<frame::Annotation::axes>;
std::string light_text(State s) {
    return s.light < 0 ? "" : fmt::format("light {}", s.light + 1);
}
std::string turntable_text(State s) {
    return on_off(s.look.turntable);
}
std::string info_text(State s) {
    return on_off(s.info);
}
std::string warnings_text(State s) {
    return on_off(s.warnings > 0);
}
std::string doctor_text(State s) {
    return on_off(s.doctor > 0);
}
std::string error_map_text(State s) {
    return on_off(s.error_map);
}
std::string split_text(State s) {
    return on_off(s.split);
}
std::string explain_text(State s) {
    return on_off(s.explain > 0);
}

template <std::size_t axis>
std::string asked_text(State s) {
    return s.look.rendering.asked[axis];
}
std::string stops_text(State s) {
    return exposure_text(s.look.rendering.exposure);
}
std::string behind_text(State s) {
    return background_text(s.look.rendering.background);
}

std::string scale_axis_text(State s) {
    constexpr std::array<std::string_view, 4> kNames = {"all axes", "x alone", "y alone",
                                                        "z alone"};
    return std::string(kNames[static_cast<std::size_t>(s.scale_axis + 1)]);
}
std::string fly_text(State s) {
    return s.look.flies ? "flies" : "orbit";
}

// clang-format off
// Rows stand in the order of ActionId. Columns: id, name, keys, sheet, help, numbers, repeats, state, changes.
constexpr auto kRows = std::to_array<ActionRow>({
    {Id::rotate_left, "rotate_left", "Left", "Arrows", "rotate", 0, true},
    {Id::rotate_right, "rotate_right", "Right", "", "rotate", 0, true},
    {Id::rotate_up, "rotate_up", "Up", "", "rotate", 0, true},
    {Id::rotate_down, "rotate_down", "Down", "", "rotate", 0, true},
    {Id::move_left, "move_left", "Shift+Left", "Shift+arrows", "move", 0, true},
    {Id::move_right, "move_right", "Shift+Right", "", "move", 0, true},
    {Id::move_up, "move_up", "Shift+Up", "", "move", 0, true},
    {Id::move_down, "move_down", "Shift+Down", "", "move", 0, true},
    {Id::previous_file, "previous_file", "PageUp", "PgUp PgDn", "previous, next file"},
    {Id::next_file, "next_file", "PageDown", "", "next file"},
    {Id::scale_up, "scale_up", "+ = KP+", "+ -", "scale", 0, true},
    {Id::scale_down, "scale_down", "- KP-", "", "scale", 0, true},
    {Id::roll_left, "roll_left", "[", "[ ]", "roll", 0, true},
    {Id::roll_right, "roll_right", "]", "", "roll", 0, true},
    {Id::reset, "reset", "Home R", "Home R", "back to the start"},
    {Id::fit, "fit", "F", "F", "fit into the picture"},
    {Id::toggle_drive, "toggle_drive", "O", "O", "the keys drive:", 0, false, drive_text, "keys drive"},
    {Id::view_front, "view_front", "1 KP1", "1 3 7 9", "front, right, top, iso view", 0, false, view_text, "view"},
    {Id::view_back, "view_back", "Ctrl+1 Ctrl+KP1", "Ctrl+1 3 7 9", "the opposite views"},
    {Id::view_right, "view_right", "3 KP3", "", "right view"},
    {Id::view_left, "view_left", "Ctrl+3 Ctrl+KP3", "", "left view"},
    {Id::view_top, "view_top", "7 KP7", "", "top view"},
    {Id::view_bottom, "view_bottom", "Ctrl+7 Ctrl+KP7", "", "bottom view"},
    {Id::view_iso, "view_iso", "9 KP9", "", "iso view"},
    {Id::view_iso_back, "view_iso_back", "Ctrl+9 Ctrl+KP9", "", "opposite of the iso view"},
    {Id::toggle_projection, "toggle_projection", "5 KP5", "5", "projection:", 0, false, projection_text, "projection"},
    {Id::up_axis_next, "up_axis_next", "Y", "Y", "up axis:", 0, false, up_text, "up axis"},
    {Id::cull_next, "cull_next", "C", "C", "faces left out:", 0, false, cull_text, "faces left out"},
    {Id::colour_next, "colour_next", "M", "M", "colour by:", 0, false, colour_text, "colour by"},
    {Id::section_next, "section_next", "J", "J { }", "section, slide it:", 0, false, section_text, "section"},
    {Id::section_flip, "section_flip", "Shift+J", "Shift+J", "its other side", 0, false, section_text, "section"},
    {Id::section_down, "section_down", "{", "", "slide the section", 0, true, section_text, "section"},
    {Id::section_up, "section_up", "}", "", "slide the section", 0, true, section_text, "section"},
    {Id::slide_section, "slide_section", "", "", "slide the section", 1, false, section_text, "section"},
    {Id::toggle_measuring, "toggle_measuring", "T", "T", "measure by clicks:", 0, false, measuring_text, "measuring"},
    {Id::edges_next, "edges_next", "E", "E", "edges:", 0, false, edges_text, "edges"},
    {Id::toggle_points, "toggle_points", "P", "P", "vertices:", 0, false, points_text, "vertices"},
    {Id::toggle_normals, "toggle_normals", "N", "N", "normals:", 0, false, normals_text, "normals"},
    {Id::toggle_box, "toggle_box", "B", "B", "bounding box:", 0, false, box_text, "bounding box"},
    {Id::toggle_grid, "toggle_grid", "G", "G", "grid on the ground:", 0, false, grid_text, "grid"},
    {Id::toggle_axes, "toggle_axes", "A", "A", "axes x y z:", 0, false, axes_text, "axes"},
    {Id::light_next, "light_next", "L", "L", "next light: arrows, + -", 0, false, light_text},
    {Id::toggle_info, "toggle_info", "I", "I", "information:", 0, false, info_text, "information"},
    {Id::toggle_explain, "toggle_explain", "X", "X", "what runs, and why:", 0, false, explain_text, "what runs, and why"},
    {Id::toggle_doctor, "toggle_doctor", "D", "D", "hazards of the file:", 0, false, doctor_text},
    {Id::toggle_error_map, "toggle_error_map", "V", "V", "map of the errors:", 0, false, error_map_text, "map of the errors"},
    {Id::rung_down, "rung_down", ",", ", .", "quicker, more accurate rungs", 0, true},
    {Id::rung_up, "rung_up", ".", "", "more accurate rungs", 0, true},
    {Id::toggle_split, "toggle_split", "/", "/ < >", "split, now | reference:", 0, false, split_text, "split view"},
    {Id::split_left, "split_left", "<", "", "move the split line", 0, true},
    {Id::split_right, "split_right", ">", "", "move the split line", 0, true},
    {Id::toggle_turntable, "toggle_turntable", "Space", "Space", "turntable:", 0, false, turntable_text, "turntable"},
    {Id::undo, "undo", "U", "U", "undo"},
    {Id::reload, "reload", "F5", "F5", "read the file again"},
    {Id::screenshot, "screenshot", "S F12", "S F12", "write a picture file"},
    {Id::print_view, "print_view", "K", "K", "this view as a command"},
    {Id::toggle_help, "toggle_help", "H ?", "H ?", "this help"},
    {Id::close, "close", "Escape", "Esc", "close the open panel, else quit"},
    {Id::quit, "quit", "Q Ctrl+C", "Q Ctrl+C Ctrl+Z", "quit, suspend"},
    {Id::suspend, "suspend", "Ctrl+Z", "", "suspend; fg comes back"},
    {Id::toggle_warnings, "toggle_warnings", "Shift+I", "Shift+I", "warnings of the file:", 0, false, warnings_text},
    {Id::shading_next, "shading_next", "F2", "F2", "shading:", 0, false, asked_text<0>, "shading"},
    {Id::shading_previous, "shading_previous", "Shift+F2", "", "shading, back", 0, false, asked_text<0>, "shading"},
    {Id::aa_next, "aa_next", "F3", "F3", "anti-aliasing:", 0, false, asked_text<1>, "anti-aliasing"},
    {Id::aa_previous, "aa_previous", "Shift+F3", "", "anti-aliasing, back", 0, false, asked_text<1>, "anti-aliasing"},
    {Id::texture_next, "texture_next", "F4", "F4", "texture filter:", 0, false, asked_text<2>, "texture filter"},
    {Id::texture_previous, "texture_previous", "Shift+F4", "", "texture filter, back", 0, false, asked_text<2>, "texture filter"},
    {Id::shadow_next, "shadow_next", "F6", "F6", "shadow:", 0, false, asked_text<3>, "shadow"},
    {Id::shadow_previous, "shadow_previous", "Shift+F6", "", "shadow, back", 0, false, asked_text<3>, "shadow"},
    {Id::tone_next, "tone_next", "F8", "F8", "tone:", 0, false, asked_text<4>, "tone"},
    {Id::tone_previous, "tone_previous", "Shift+F8", "", "tone, back", 0, false, asked_text<4>, "tone"},
    {Id::ambient_occlusion_next, "ambient_occlusion_next", "F10", "F10", "ambient occlusion:", 0, false, asked_text<5>, "ambient occlusion"},
    {Id::ambient_occlusion_previous, "ambient_occlusion_previous", "Shift+F10", "", "ambient occlusion, back", 0, false, asked_text<5>, "ambient occlusion"},
    {Id::exposure_up, "exposure_up", "F7", "F7", "exposure:", 0, true, stops_text, "exposure"},
    {Id::exposure_down, "exposure_down", "Shift+F7", "", "exposure, down", 0, true, stops_text, "exposure"},
    {Id::background_next, "background_next", "F9", "F9", "background:", 0, false, behind_text, "background"},
    {Id::background_previous, "background_previous", "Shift+F9", "", "background, back", 0, false, behind_text, "background"},
    {Id::move_far, "move_far", "Ctrl+Up", "Ctrl+Up Down", "move in depth", 0, true},
    {Id::move_near, "move_near", "Ctrl+Down", "", "move towards the eye", 0, true},
    {Id::scale_axis_next, "scale_axis_next", "Z", "Z", "+ - scale:", 0, false, scale_axis_text, "+ - scale"},
    {Id::toggle_fly, "toggle_fly", "W Tab", "W, Tab back", "camera:", 0, false, fly_text, "camera"},
    {Id::fly_forward, "fly_forward", "W", "W A S D E C", "fly ahead, left, back, right, up, down", 0, true},
    {Id::fly_left, "fly_left", "A", "", "fly left", 0, true},
    {Id::fly_back, "fly_back", "S", "", "fly back", 0, true},
    {Id::fly_right, "fly_right", "D", "", "fly right", 0, true},
    {Id::fly_up, "fly_up", "E", "", "fly up", 0, true},
    {Id::fly_down, "fly_down", "C", "", "fly down", 0, true},
    {Id::drag_begin, "drag_begin", "", "", "a mouse button goes down"},
    {Id::drag_rotate, "drag_rotate", "", "Left drag", "rotate", 2},
    {Id::drag_move, "drag_move", "", "Shift/mid drag", "move", 2},
    {Id::drag_roll, "drag_roll", "", "Ctrl+drag", "roll", 2},
    {Id::drag_zoom, "drag_zoom", "", "Right drag", "scale", 2},
    {Id::drag_end, "drag_end", "", "", "the mouse button goes up"},
    {Id::zoom_at, "zoom_at", "", "Wheel, Shift+wheel", "scale there, slide section", 3},
    {Id::pointer, "pointer", "", "", "the mouse pointer moves", 2},
    {Id::frame, "frame", "", "", "in --replay files: write the picture to a file"},
});
// clang-format on

constexpr bool in_order() {
    for (std::size_t i = 0; i < kRows.size(); ++i)
        if (kRows[i].id != static_cast<Id>(i)) return false;
    return kRows.size() == static_cast<std::size_t>(Id::frame) + 1;
}
static_assert(in_order());

constexpr double kIsoElevation = 35.264389682754654; // atan(1 / sqrt 2): all axes equally long
constexpr std::array<ViewAngles, 8> kViews = {{{"front", 0, 0},
                                               {"back", 180, 0},
                                               {"right", 90, 0},
                                               {"left", 270, 0},
                                               {"top", 0, 90},
                                               {"bottom", 0, -90},
                                               {"iso", 45, kIsoElevation},
                                               {"opposite iso", 225, -kIsoElevation}}};

std::string_view take_word(std::string_view& text) {
    const std::size_t start = std::min(text.find_first_not_of(" \t"), text.size());
    text.remove_prefix(start);
    const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(end);
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    return word;
}

} // namespace

std::span<const ActionRow> action_rows() {
    return kRows;
}

const ActionRow& row_of(ActionId id) {
    return kRows[static_cast<std::size_t>(id)];
}

bool is_view(ActionId id) {
    return id >= ActionId::view_front && id <= ActionId::view_iso_back;
}

bool is_flying(ActionId id) {
    return id >= ActionId::fly_forward && id <= ActionId::fly_down;
}

std::string change_text(ActionId id, const ViewerState& state) {
    const ActionRow& row = row_of(is_view(id) ? ActionId::view_front : id); // one row for all views
    return row.changes.empty() ? "" : fmt::format("{}: {}", row.changes, row.state(state));
}

const ActionRow* find_action(std::string_view name) {
    for (const ActionRow& row : kRows)
        if (row.name == name) return &row;
    return nullptr;
}

std::string to_text(const Action& action) {
    const ActionRow& row = row_of(action.id);
    std::string text = (action.repeated ? "repeat " : "") + std::string(row.name);
    for (int i = 0; i < row.numbers; ++i)
        text += fmt::format(" {}", action.numbers[static_cast<std::size_t>(i)]);
    if (!action.text.empty()) text += " " + action.text;
    return text;
}

Result<Action> parse_action(std::string_view text) {
    Action action;
    std::string_view name = take_word(text);
    if (name == "repeat") {
        action.repeated = true;
        name = take_word(text);
    }
    const ActionRow* row = find_action(name);
    if (row == nullptr) {
        std::vector<std::string_view> names;
        names.reserve(kRows.size());
        for (const ActionRow& known : kRows)
            names.push_back(known.name);
        std::string hint = did_you_mean(name, names);
        for (const std::string_view known : names) // move_pointer
            if (hint.empty() && name.find(known) != std::string_view::npos)
                hint = fmt::format("; did you mean '{}'?", known);
        return fail(Exit::unreadable, "there is no action '{}'{}", name,
                    hint.empty() ? "; `scanout list keys` names them, docs/GUIDE.md explains them"
                                 : hint);
    }
    action.id = row->id;
    for (int i = 0; i < row->numbers; ++i) {
        const std::string_view word = take_word(text);
        const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(),
                                                   action.numbers[static_cast<std::size_t>(i)]);
        if (error != std::errc() || stop != word.data() + word.size())
            return fail(Exit::unreadable, "{} wants {} whole numbers", name, row->numbers);
    }
    if (action.id == ActionId::frame) {
        if (text.empty())
            return fail(Exit::unreadable, "frame wants a file name, as in frame 1.png");
        if (!format_of_name(text))
            return fail(Exit::unreadable, "frame {}: the name must end in .png, .ppm, .pam or .raw",
                        text);
        action.text = text;
    } else if (!text.empty()) {
        return fail(Exit::unreadable, "'{}' after {} is too much; take it out", text, name);
    }
    return action;
}

const ViewAngles& view_angles(int view) {
    CHECK(view >= 0 && view < static_cast<int>(kViews.size()));
    return kViews[static_cast<std::size_t>(view)];
}

std::string_view name_of(scene::Projection projection) {
    return projection == scene::Projection::perspective ? "perspective" : "orthographic";
}

std::string_view name_of(frame::Cull cull) {
    constexpr std::array<std::string_view, 4> kNames = {"material", "none", "back", "front"};
    return kNames[static_cast<std::size_t>(cull)];
}

} // namespace scanout::app
