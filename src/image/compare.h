// Two pictures against each other: two numbers as tolerance, never one.
#pragma once

#include "image/image.h"

#include <cstdint>

namespace scanout::image {

struct Difference {
    bool same_size = false;
    int max_difference = 0;            // largest difference of any channel, in codes
    std::int64_t differing_pixels = 0; // pixels in which some channel differs
    std::int64_t over_tolerance = 0;   // pixels in which some channel differs by more than asked
};

// over_tolerance counts pixels with a channel difference > max_difference_allowed. Pictures of
// different sizes are not compared further: the counts stay 0.
Difference compare(const Image& a, const Image& b, int max_difference_allowed = 0);

// |a - b| per channel, times `gain`, opaque, on black; a difference of alpha counts in every
// channel. Where sizes differ, the result has the larger width and height, and is white where not
// both have pixels.
Image difference_image(const Image& a, const Image& b, int gain = 16);

} // namespace scanout::image
