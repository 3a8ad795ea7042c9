// Which connector, mode and CRTC of a card to use.
#pragma once

#include "base/result.h"
#include "platform/drm/device.h"
#include "platform/drm/display.h"

namespace scanout::drm {

struct Choice {
    Connector connector;
    drmModeModeInfo mode{};
    std::uint32_t crtc = 0;
};

double refresh_hz(const drmModeModeInfo& mode);

// Empty or "preferred": the mode that the display prefers, else the one with the most pixels (then
// the highest refresh), which is "highest", too. "1920x1080": its highest refresh; "1920x1080@60":
// the nearest within 1 Hz.
Result<drmModeModeInfo> choose_mode(const Connector& connector, const std::string& wanted);

// Errors are one reason each ("no connected connector"), without the card's name.
Result<Choice> choose(Device& device, const Options& options);

} // namespace scanout::drm
