// What the viewer saves while something moves: the levels of governor.h as samples and render
// scales.
#pragma once

#include "frame/options.h"

#include <string_view>
#include <vector>

namespace scanout::app {

struct MotionLevel {
    std::string_view render_scale; // of the axis; "" for the options' own
    bool one_sample = false;       // a pixel; else the options' own number
    double share = 1;              // of the work that the options' own choice takes
};

// The options as they are, and below them one sample a pixel, then each smaller render scale, the
// best first. may_thin, may_scale: false leaves these out.
std::vector<MotionLevel> motion_levels(const frame::FrameOptions& options, bool may_thin,
                                       bool may_scale);

} // namespace scanout::app
