// Where a block's lanes lie in the picture, and the rays from the eye through them.
#pragma once

#include "image/image.h"
#include "shade/stage.h"

namespace scanout::shade {

// The ray of a sample at (x, y) pixels: (x scale_x + offset_x, y scale_y + offset_y, -1).
struct Rays {
    float scale_x = 0, offset_x = 0, scale_y = 0, offset_y = 0;
};

// x and y of lanes first to first + count: the centres of these pixels, pixel[lane] by its number
// in the tile whose corner is (x0, y0).
void place_at_centres(Block& block, const std::int32_t* pixel, int first, int count, int x0,
                      int y0);

// The rays, of x and y.
void set_rays(Block& block, const Rays& rays);

// The codes of `count` lanes, at most kBlockSize, to their pixels of the tile with this corner; in
// the picture the pixels of a column lie `width` apart.
void put_codes(const std::uint32_t* code, const std::int32_t* pixel, int count,
               image::Rgba8* corner, int width);

} // namespace scanout::shade
