// What a quick measurement spends.
#pragma once

#include "measure/frontier.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace scanout::app {

inline constexpr double kQuickSeconds = 10;         // of measuring, after the reference
inline constexpr std::uint32_t kQuickSamples = 128; // of the reference, a pixel, at most

// What one point may take of the time for all of them.
inline double seconds_a_point(double seconds) {
    return seconds / 240;
}

// The search for rungs that somebody waits for: what they take and how they err, nothing else.
inline measure::FrontierOptions quick_search(std::vector<std::string> axes) {
    measure::FrontierOptions how;
    how.axes = std::move(axes);
    how.seconds = kQuickSeconds;
    how.seconds_a_point = seconds_a_point(how.seconds);
    how.effects = false;
    how.flip = measure::FrontierOptions::Flip::none;
    return how;
}

} // namespace scanout::app
