// Linear light -> the picture's pixels. In linear light throughout, encoded once.
#pragma once

#include "image/image.h"

#include <cstdint>
#include <vector>

namespace scanout::shade {

// Pixels that hold one fragment only: their colours encoded, alpha full. Arrays may be read and
// written up to a register beyond count (stage.h, kRoom).
void encode_pixels(const float* red, const float* green, const float* blue, int count,
                   std::uint32_t* out);

// Pixels that several fragments share, or that the background shows through: sums over their
// samples, in linear light.
struct PixelSums {
    std::vector<float> red, green, blue;
    std::vector<float> through; // the background's share of the pixel
    // Room for count pixels, all zero, and a register more.
    void reset(std::size_t count);
};
// A pixel's colour counts by its alpha, as PNG and PAM want it: where the background lets through,
// the primitive's colour is undiluted by it.
void resolve_pixels(const PixelSums& sums, const image::Rgba8& background, int count,
                    std::uint32_t* out);

} // namespace scanout::shade
