// The mean over tiles of 4 x 4 pixels, of those that lie in a pixel's own plane: takes out the
// pattern of horizon.h and keeps the edges of surfaces. Jimenez et al. 2016; along rows, then along
// columns.
#pragma once

#include "shade/ambient_occlusion.h"

namespace scanout::shade::ambient_occlusion {

// Of the rows from y0 on, up to y1; rows of `stride` floats.
void blur_along_rows(const SurfaceImage& image, int y0, int y1, const float* from, float* to);
void blur_along_columns(const SurfaceImage& image, int y0, int y1, const float* from, float* to);

} // namespace scanout::shade::ambient_occlusion
