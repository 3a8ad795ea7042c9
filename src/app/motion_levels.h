// What the viewer saves while something moves: the levels of governor.h as render scales.
#pragma once

#include "frame/options.h"

#include <string_view>
#include <vector>

namespace scanout::app {

struct MotionLevel {
    std::string_view render_scale; // of the axis; "" for the options' own
    double share = 1;              // of the pixels that the options' own scale draws
};

// The options as they are, and below them each smaller render scale, the best first. may_scale:
// false leaves the first one alone.
std::vector<MotionLevel> motion_levels(const frame::FrameOptions& options, bool may_scale);

} // namespace scanout::app
