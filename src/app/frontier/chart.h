// Error against time, both in logarithms: every point measured, the frontier, the reference's own
// noise. As SVG, as a picture, and as text for a terminal.
#pragma once

#include "app/frontier/report.h"
#include "image/image.h"

#include <string>
#include <vector>

namespace scanout::app {

struct ChartPoint {
    double time = 0, time_low = 0, time_high = 0;    // ms of CPU time; a 95 % interval
    double error = 0, error_low = 0, error_high = 0; // codes; as the reference's noise leaves it
    int number = 0;                                  // on the frontier, from 1; 0: beside it
    bool asked = false;
    std::string name;
};
struct Chart {
    std::string title;
    std::vector<ChartPoint> points; // those of the frontier by number, then the others
    double noise = 0;               // codes
};
Chart frontier_chart(const FrontierReport& report);

// A whole file; also what stands inside HTML.
std::string chart_svg(const Chart& chart);
// The same drawn by the program's own font.
image::Image chart_picture(const Chart& chart);
// At most 80 columns.
std::vector<std::string> text_plot(const Chart& chart);

} // namespace scanout::app
