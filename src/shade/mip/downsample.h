// Downsampling: computes a row of a mip level from the level above (mip_chain.h).
#pragma once

#include <cstdint>

namespace scanout::shade {

// Rows from the top: codes of an image, or else four floats a texel.
struct LevelAbove {
    std::int32_t width, height;
    const std::int32_t* codes;    // image::Rgba8, red in the lowest byte; null: floats
    const double *colour, *alpha; // of 256 codes, each a float's value
    const float* texels;          // red, green, blue, alpha
};

// Computes row y of the level below, four floats a texel: `width` texels, half as many as above.
void downsample_row(const LevelAbove& above, int y, int width, float* row);

} // namespace scanout::shade
