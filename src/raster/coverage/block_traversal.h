// Block traversal: types that the kernels share which visit the blocks of a tile under a triangle.
#pragma once

#include "raster/coverage/coverage.h"

#include <cstdint>

namespace scanout::raster {

// A triangle is traversed in blocks of 8 x 8 pixels. Within a block all samples of one pattern
// index lie whole pixels apart, so an edge function is E + 256 n with an integer n, and E + 256 n +
// bias >= 0 exactly when floor((E + bias) / 256) + n >= 0: the pixels need 32 bits only however
// large the triangle is (|n| < 2^28; the floor saturates at 2^29).
struct PixelBlock {
    static constexpr int kSide = 8;
};

// Upper bounds of a triangle in the blocks of a tile, by column and row: of each edge function
// (times any number above 0) and of depth, at the tile's first block, and their steps a block.
struct BlockBounds {
    float edge[3], across[3], down[3];
    float depth, depth_across, depth_down;
    float most;         // of depth, anywhere
    int x0, y0, x1, y1; // the blocks that are visited
    // Rounding of the float sums over all of a tile is far less than this part of their terms. The
    // terms are far above the smallest floats: depths are 2^-120 or more (scene/view.cpp).
    static constexpr double kMargin = 0x1p-18;
};
struct BlockList {
    static constexpr int kRow = kTileSize / PixelBlock::kSide, kBlocks = kRow * kRow;
    std::int32_t x[kBlocks], y[kBlocks];
    int count;
};

// The three edge functions of a clipped triangle over a block, at the samples of one pattern index:
// at the first pixel and their steps a pixel, rounded to double, and a bound of the rounding error
// anywhere in the block. All 0: the edge holds for the whole block.
struct ClippedBlockEdges {
    double first[3], per_x[3], per_y[3], error[3];
};
// Bit 8 y + x. unsure: pixels where the rounding error may exceed the edge function.
struct ClippedBlockSigns {
    std::uint64_t inside, unsure;
};

// The pixels of a block in which a clipped triangle covers a sample, and its depth there: input of
// the depth write.
struct ClippedBlock {
    std::uint64_t inside;        // bit 8 y + x
    const float* depths;         // of the pixels, eight a row; null: on a plane
    double corner, per_x, per_y; // the plane, from the first pixel's sample on, in pixels
    double least, most;          // of the vertices: no depth lies beyond, not even by rounding
    std::uint32_t id;
};

} // namespace scanout::raster
