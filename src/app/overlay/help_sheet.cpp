#include "app/overlay/help_sheet.h"

#include "app/view/actions.h"

#include <algorithm>
#include <array>
#include <utility>

namespace scanout::app {
namespace {

using Id = ActionId;

// The sections in their order, and in each the rows of the sheet: the first action of each.
struct SectionRow {
    std::string_view heading;
    Id action;
};
constexpr std::string_view kMove = "Move", kViews = "Views", kRendering = "Rendering",
                           kDrawnOver = "Structure", kPanels = "Panels",
                           kProgram = "Files and program";
constexpr auto kSections = std::to_array<SectionRow>({
    {kMove, Id::rotate_left},
    {kMove, Id::move_left},
    {kMove, Id::move_far},
    {kMove, Id::scale_up},
    {kMove, Id::scale_axis_next},
    {kMove, Id::roll_left},
    {kMove, Id::toggle_drive},
    {kMove, Id::toggle_turntable},
    {kMove, Id::toggle_fly},
    {kMove, Id::fly_forward},
    {kMove, Id::drag_rotate},
    {kMove, Id::drag_move},
    {kMove, Id::drag_roll},
    {kMove, Id::drag_zoom},
    {kMove, Id::zoom_at},
    {kMove, Id::undo},
    {kViews, Id::view_front},
    {kViews, Id::view_back},
    {kViews, Id::reset},
    {kViews, Id::fit},
    {kViews, Id::toggle_projection},
    {kViews, Id::up_axis_next},
    {kRendering, Id::shading_next},
    {kRendering, Id::aa_next},
    {kRendering, Id::texture_next},
    {kRendering, Id::shadow_next},
    {kRendering, Id::ambient_occlusion_next},
    {kRendering, Id::exposure_up},
    {kRendering, Id::tone_next},
    {kRendering, Id::background_next},
    {kRendering, Id::light_next},
    {kRendering, Id::rung_down},
    {kRendering, Id::cull_next},
    {kDrawnOver, Id::colour_next},
    {kDrawnOver, Id::edges_next},
    {kDrawnOver, Id::toggle_points},
    {kDrawnOver, Id::toggle_normals},
    {kDrawnOver, Id::toggle_box},
    {kDrawnOver, Id::toggle_grid},
    {kDrawnOver, Id::toggle_axes},
    {kDrawnOver, Id::section_next},
    {kDrawnOver, Id::section_flip},
    {kDrawnOver, Id::toggle_measuring},
    {kPanels, Id::toggle_info},
    {kPanels, Id::toggle_warnings},
    {kPanels, Id::toggle_explain},
    {kPanels, Id::toggle_doctor},
    {kPanels, Id::toggle_error_map},
    {kPanels, Id::toggle_split},
    {kPanels, Id::toggle_help},
    {kPanels, Id::close},
    {kProgram, Id::previous_file},
    {kProgram, Id::reload},
    {kProgram, Id::screenshot},
    {kProgram, Id::print_view},
    {kProgram, Id::quit},
});

} // namespace

std::vector<SheetSection> help_sheet(const ViewerState& state, const KeyMap& keys) {
    std::vector<SheetSection> sections;
    for (const auto& [heading, action] : kSections) {
        if (sections.empty() || sections.back().heading != heading)
            sections.push_back({heading, {}});
        const ActionRow& row = row_of(action);
        std::string label = keys.label(row);
        if (label.empty()) continue; // no key does it
        sections.back().rows.push_back({std::move(label), std::string(row.help),
                                        row.state != nullptr ? row.state(state) : std::string()});
    }
    return sections;
}

} // namespace scanout::app
