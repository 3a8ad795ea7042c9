// Render scales (axis `render_scale`): the share of the picture's size, on each side, at which a
// frame is drawn. image/enlarge.h brings it to its full size.
#pragma once

#include "base/technique.h"

#include <span>
#include <string_view>

namespace scanout::frame {

struct RenderScale {
    Technique card;
    int numerator = 1, denominator = 1; // of the share, at most 1

    bool is_full() const { return numerator == denominator; }
    // Of a side of so many pixels: those that are drawn, rounded up.
    int drawn(int pixels) const { return (pixels * numerator + denominator - 1) / denominator; }
};

} // namespace scanout::frame
