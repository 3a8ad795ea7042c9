// The texts of the overlay, from the viewer's state.
#pragma once

#include "app/options/settings.h"
#include "app/overlay/overlay.h"
#include "app/view/model_slot.h"
#include "app/view/viewer.h"
#include "frame/blank_picture.h"
#include "frame/renderer.h"

#include <optional>
#include <string>
#include <string_view>

namespace scanout::app {

// Help, information, error and message; the plan's lines come from live_explain.h. `message` is
// shown if there is one, else the line of the light that is selected.
std::vector<std::string> info_lines(const Viewer& viewer, const ModelSlot& slot,
                                    const Settings& settings);
Overlay overlay_text(const Viewer& viewer, const ModelSlot& slot, const Settings& settings,
                     const std::string& message, const KeyMap& keys);

// Adds the lines that depend on the frame that is being shown.
struct FrameFacts {
    std::optional<frame::Blank> blank; // why nothing of the model shows
    bool times = true;                 // print the times
    double frames_per_second = 0;
    frame::FrameStats stats;
    std::string_view render_scale = {}; // at which it is drawn to hold the budget; empty: its own
};
void add_frame_text(Overlay& overlay, const FrameFacts& frame);

} // namespace scanout::app
