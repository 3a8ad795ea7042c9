// Errors as pictures: from black over purple and orange to pale yellow, each step as much lighter
// to the eye as the one before. The colours are those of the map magma (Smith and van der Walt
// 2015).
#pragma once

#include "image/image.h"

#include <array>
#include <span>

namespace scanout::image {

// 0 is black, 1 the palest; clamped.
Rgba8 heat_colour(double share);

// Of values in [0, 1], rows from the top, as flip_map() has them.
Image heat_map(int width, int height, std::span<const float> values);

// The largest difference of a channel, 0 to 255.
int largest_difference(const Rgba8& p, const Rgba8& q);
// The colour of each such difference: 0 is black, and each doubling of difference + 1 is an eighth
// of the way, so that one code can be told from none, and 255 is the palest.
const std::array<Rgba8, 256>& colours_of_differences();

// Of the largest difference of each pixel. Both pictures have the same size.
Image heat_map(const Image& reference, const Image& test);

} // namespace scanout::image
