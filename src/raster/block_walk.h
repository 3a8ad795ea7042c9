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

// Of a triangle in the blocks of a tile, by their column and row: what no edge function (times any
// number above 0) and no depth is greater than, at the tile's first block and its steps a block.
struct BlockBounds {
    float edge[3], across[3], down[3];
    float depth, depth_across, depth_down;
    float most;         // of depth, anywhere
    int x0, y0, x1, y1; // the blocks asked about
    // What is added up in float, over all of a tile, is rounded by far less than this of its terms,
    // which are far from the least floats: depths are 2^-120 or more (scene/view.cpp).
    static constexpr double kMargin = 0x1p-18;
};
struct BlockList {
    static constexpr int kRow = kTileSize / BlockWalk::kSide, kBlocks = kRow * kRow;
    std::int32_t x[kBlocks], y[kBlocks];
    int count;
};

// The three edge functions of a piece over a block, at the samples of one place in the pattern: at
// the first pixel and their steps a pixel, rounded to double, and how far what lanes make of these
// may lie from the truth, anywhere in the block. All 0: the edge holds for the whole block.
struct PieceBlockEdges {
    double first[3], per_x[3], per_y[3], error[3];
};
// Bit 8 y + x. unsure: pixels whose sign the errors leave open.
struct PieceBlockSigns {
    std::uint64_t inside, unsure;
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
