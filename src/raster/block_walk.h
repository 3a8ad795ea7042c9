// What kernels need to draw the blocks of a tile that a triangle may cover.
#pragma once

#include "raster/coverage.h"

#include <cstdint>

namespace scanout::raster {

// A triangle is walked over in blocks of 8 x 8 pixels. Within a block all samples of one place in
// the pattern lie whole pixels apart, so an edge function is E + 256 n with an integer n, and
// E + 256 n + bias >= 0 exactly when floor((E + bias) / 256) + n >= 0: the pixels need 32 bits only
// however large the triangle is (|n| < 2^28; the floor saturates at 2^29).
struct BlockWalk {
    static constexpr int kSide = 8;
};

// The pixels of a block in which a piece of a triangle covers a sample, and its depth there: what
// is left to do for the lanes.
struct PieceBlock {
    std::uint64_t inside;        // bit 8 y + x
    const float* depths;         // of the pixels, eight a row; null: on a plane
    double corner, per_x, per_y; // the plane, from the first pixel's sample on, in pixels
    double least, most;          // of the vertices: no depth lies beyond, not even by rounding
    std::uint32_t id;
};

} // namespace scanout::raster
