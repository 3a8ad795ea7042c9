// The panel of the frontier: where the rungs on show stand between time and error.
#pragma once

#include "image/image.h"

#include <cstddef>
#include <string>
#include <vector>

namespace scanout::app {

struct FrontierPanel {
    std::vector<std::string> lines; // the rungs on show, their time and error; or how far it is
    struct Point {
        double ms = 0, error = 0; // error: codes RMSE
        friend bool operator==(const Point&, const Point&) = default;
    };
    std::vector<Point> points; // quickest first; empty: no plot
    std::size_t at = 0;        // the one on show
    friend bool operator==(const FrontierPanel&, const FrontierPanel&) = default;
};

int frontier_panel_width(const FrontierPanel& panel, int scale); // pixels

// At the right, `top` pixels from above: lines, and under them time to the right and error upwards,
// both by their logarithms, with their values at both ends.
void draw_frontier_panel(image::Image& picture, const FrontierPanel& panel, int top, int scale);

} // namespace scanout::app
