// The overlay of the picture: the help sheet, the information lines, the plan, a message, a notice
// in the middle. All is text in the bitmap font; it depends on the clock only where its text does.
#pragma once

#include "app/frontier/measurement.h"
#include "app/overlay/frontier_panel.h"
#include "app/overlay/help_sheet.h"
#include "app/view/pixel_place.h"
#include "app/view/viewer_state.h"
#include "image/image.h"

#include <optional>
#include <string>
#include <vector>

namespace scanout::app {

// What the colours of an error map mean, and what it says of a pixel. Without a map, why.
struct ErrorLegend {
    std::vector<std::string> lines;
    bool has_map = false; // with its colours, and as wide whatever the lines say
    friend bool operator==(const ErrorLegend&, const ErrorLegend&) = default;
};

// The line of the split view, and the names of its sides.
struct SplitLine {
    int x = 0; // pixels from the left: the first column of the right side
    std::string left, right;
    friend bool operator==(const SplitLine&, const SplitLine&) = default;
};

struct Overlay {
    HelpPage help;                             // empty: closed
    std::vector<std::string> info;             // lines at the upper left
    std::vector<std::string> explain;          // lines under them
    std::vector<std::string> doctor, warnings; // lines in their place
    std::optional<PixelPlace> mark;            // of the place that they are about
    std::optional<MeasuredMarks> measured;
    std::string message;             // a line at the lower left; after \n more, as long as it takes
    std::vector<std::string> notice; // lines in the middle: loading, errors
    std::optional<ErrorLegend> legend; // at the lower right
    std::optional<SplitLine> split;
    std::optional<FrontierPanel> frontier; // at the upper right
    friend bool operator==(const Overlay&, const Overlay&) = default;
};

// How many letters fit side by side in a picture of this size.
std::size_t letters_across(int width, int height);
// How many lines of text fit above the message.
std::size_t lines_down(int width, int height);

void draw_overlay(image::Image& picture, const Overlay& overlay);

} // namespace scanout::app
