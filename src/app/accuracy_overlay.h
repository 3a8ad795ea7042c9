// Overlays of the error map and of the split view.
#pragma once

#include "app/overlay.h"
#include "image/image.h"

namespace scanout::app {

// At the lower right: what is known of a pixel, a bar of the map's colours, and their codes.
// Returns its height.
int draw_error_legend(image::Image& picture, const ErrorLegend& legend, int scale);

// The line, and at its lower end, but `above_end` pixels above it, the names of its sides.
void draw_split_line(image::Image& picture, const SplitLine& split, int above_end, int scale);

} // namespace scanout::app
