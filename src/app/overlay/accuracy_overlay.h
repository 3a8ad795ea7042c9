// Overlays of the error map and of the split view.
#pragma once

#include "app/overlay/overlay.h"
#include "image/image.h"

namespace scanout::app {

// At the right, with its lower end at `bottom`: the lines, and where there is a map, a bar of its
// colours and their codes. What is wider than the picture is broken. Returns its height.
int draw_error_legend(image::Image& picture, const ErrorLegend& legend, int bottom, int scale);

// From edge to edge: panels lie over it.
void draw_split_line(image::Image& picture, int x, int scale);
// The names of the line's sides, with their lower ends at `bottom`, broken where a side is narrow.
void draw_split_names(image::Image& picture, const SplitLine& split, int bottom, int scale);

} // namespace scanout::app
