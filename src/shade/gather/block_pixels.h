// The pixels of a block: their sample positions and rays, and the storing of their codes.
#pragma once

#include "image/image.h"
#include "shade/stage.h"

namespace scanout::shade {

// The ray of a sample at (x, y) pixels: (x scale_x + offset_x, y scale_y + offset_y, -1).
struct Rays {
    float scale_x = 0, offset_x = 0, scale_y = 0, offset_y = 0;
};

// Sets x and y of items first to first + count to the centres of these pixels. pixel[item]: the
// pixel's number in the tile, whose corner is (x0, y0).
void place_at_centres(ShadingBlock& block, const std::int32_t* pixel, int first, int count, int x0,
                      int y0);

// Sets the rays from x and y.
void set_rays(ShadingBlock& block, const Rays& rays);

// Stores the codes of `count` items, at most kBlockSize, to their pixels of the tile with this
// corner. width: pixels from row to row of the picture.
void store_codes(const std::uint32_t* code, const std::int32_t* pixel, int count,
                 image::Rgba8* corner, int width);

} // namespace scanout::shade
