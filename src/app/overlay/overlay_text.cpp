#include "app/overlay/overlay_text.h"

#include "app/files.h"
#include "app/overlay/text_block.h"

#include <fmt/format.h>

namespace scanout::app {

std::vector<std::string> info_lines(const Viewer& viewer, const ModelSlot& slot,
                                    const Settings& settings) {
    const ViewerState& state = viewer.state();
    const std::string& path = settings.arguments[static_cast<std::size_t>(state.file)];
    std::vector<std::string> lines;
    lines.push_back(fmt::format("{}  ({} of {})", file_name_of(path), state.file + 1,
                                settings.arguments.size()));
    if (const LoadedModel* const model = slot.model())
        lines.push_back(fmt::format(
            "{} triangles  {} vertices  {} warnings{}  {}x{}", model->scene.counts.triangles,
            model->scene.counts.vertices, model->warnings.size(),
            model->warnings.empty() ? "" : " (Shift+I)", viewer.width(), viewer.height()));
    lines.push_back(fmt::format("{}  up {}  cull {}  {} mode", name_of(state.look.projection),
                                name_of(state.look.up), name_of(state.look.cull),
                                state.camera_mode ? "camera" : "model"));
    if (const auto seconds = viewer.motion_time())
        lines.push_back(fmt::format("motion {:.2f} of {:.4g} s  {}", *seconds,
                                    settings.motion->duration,
                                    state.look.plays ? "plays" : "rests"));
    return lines;
}

namespace {

// What a key can do about a picture that shows nothing.
const char* hint_at(frame::Blank why) {
    switch (why) {
    case frame::Blank::outside:
        return "model out of view: press R";
    case frame::Blank::section:
        return "the section cuts all of the model away: press J, or slide it with { }";
    case frame::Blank::culled:
        return "all faces that look this way are left out: press C";
    case frame::Blank::edge_on:
        return "a flat model, seen from its edge: turn it, or press 9";
    case frame::Blank::no_sample:
        return "the model is too small or too near to be seen: press R";
    case frame::Blank::no_area:
        return "no face of the model has an area";
    case frame::Blank::clear:
        return "all materials of the model are clear";
    case frame::Blank::cut_out:
        return "the materials are clear where you look: turn the model, or press R";
    case frame::Blank::depth_test:
        break;
    }
    return "the depth test lets nothing through";
}

} // namespace

Overlay overlay_text(const Viewer& viewer, const ModelSlot& slot, const Settings& settings,
                     const std::string& message, const KeyMap& keys) {
    const std::size_t letters = letters_across(viewer.width(), viewer.height());
    Overlay overlay;
    if (const int page = viewer.state().help; page > 0) {
        std::vector<HelpPage> pages = help_pages(help_sheet(viewer.state(), keys), letters,
                                                 lines_down(viewer.width(), viewer.height()));
        overlay.help = std::move(pages[std::min(static_cast<std::size_t>(page), pages.size()) - 1]);
    }
    overlay.message = message;
    if (message.empty() && slot.mesh() != nullptr)
        overlay.message = viewer.light_line(*slot.mesh(), letters);
    if (!slot.error().empty()) overlay.notice = broken_into_lines(slot.error(), letters);
    if (viewer.state().info) overlay.info = info_lines(viewer, slot, settings);
    return overlay;
}

void add_frame_text(Overlay& overlay, const FrameFacts& frame) {
    if (frame.blank && overlay.message.empty()) overlay.message = hint_at(*frame.blank);
    if (!frame.times) return;
    if (!overlay.info.empty())
        overlay.info.push_back(
            fmt::format("{:.1f} ms  {:.0f} fps{}{}", frame.stats.total_ms, frame.frames_per_second,
                        frame.render_scale.empty() ? "" : "  render scale ", frame.render_scale));
    if (!overlay.explain.empty())
        overlay.explain.push_back(fmt::format("geometry {:.1f} ms  tiles {:.1f} ms",
                                              frame.stats.geometry_ms, frame.stats.tiles_ms));
}

} // namespace scanout::app
