// What kernels need to draw the blocks of a tile that a triangle may cover.
#pragma once

#include "raster/coverage.h"

#include <cstdint>

namespace scanout::raster {

// A triangle's walk over a tile, in blocks of 8 x 8 pixels. Within a block all samples of one place
// in the pattern lie whole pixels apart, so an edge function is E + 256 n with an integer n, and
// E + 256 n + bias >= 0 exactly when floor((E + bias) / 256) + n >= 0: the pixels need 32 bits only
// however large the triangle is (|n| < 2^28; the floor saturates at 2^29).
struct BlockWalk {
    static constexpr int kSide = 8;

    Edges edges;
    DepthPlane depth;
    std::uint32_t id;
    int x0, y0, x1, y1; // blocks, of the tile
    int row0, row1;     // of the tile: the rows that can hold a sample
    // How far an edge function may lie below and above its value at a block's corner.
    std::int64_t lowest[3], highest[3];
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
