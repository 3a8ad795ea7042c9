// Where a block's lanes are sampled: at the pixel's centre where the triangle covers it, else at
// its first visible sample.
#pragma once

#include "shade/stage.h"

namespace scanout::shade {

// The ray of a sample at (x, y) pixels: (x scale_x + offset_x, y scale_y + offset_y, -1).
struct Rays {
    float scale_x = 0, offset_x = 0, scale_y = 0, offset_y = 0;
};

// Fills x and y from the block's runs, and the rays if the frame reads them.
void place_lanes(Block& block, const FrameState& frame, const Rays& rays);

} // namespace scanout::shade
