// FLIP: how different two pictures look to someone who flips between them. Andersson et al. 2020;
// the LDR metric with the paper's constants, at its 67 pixels a degree (a monitor of 3840 pixels,
// 0.7 m wide, 0.7 m away).
//
// In double, in a fixed order, with our own transcendentals: the same bits everywhere. About a
// microsecond a pixel, so on demand and never a frame.
#pragma once

#include "image/image.h"

#include <vector>

namespace scanout::image {

inline constexpr double kPixelsPerDegree = 67.0206432765823; // 0.7 m * 3840 / 0.7 m * pi / 180

// Of every pixel, rows from the top, in [0, 1]: 0 looks the same, 1 is green against blue. Both
// pictures have the same size; alpha is not looked at.
std::vector<float> flip_map(const Image& reference, const Image& test);

// The mean, which the authors recommend; 0 for equal and for empty pictures. Symmetric.
float mean_flip(const Image& reference, const Image& test);

} // namespace scanout::image
