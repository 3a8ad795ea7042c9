// The mean of a pixel's samples, where several fragments share it or the background shows through.
#pragma once

#include "image/image.h"
#include "shade/resolve/linear_picture.h"
#include "shade/resolve/output.h"

#include <cstdint>
#include <vector>

namespace scanout::shade {

// Sums over the samples of pixels, in the blend space.
struct PixelSums {
    std::vector<float> red, green, blue;
    std::vector<float> transmittance; // the weight of the background in the pixel
    std::vector<std::int32_t> alpha;  // codes; of the means
    // What resolve_area makes of them, kept for its memory.
    std::vector<std::uint32_t> codes;
    std::vector<float> offsets;
    // Room for count pixels, all zero, and a register more.
    void reset(std::size_t count);
};

// A pixel's colour counts by its alpha, as PNG and PAM want it: where the background lets through,
// the primitive's colour is undiluted by it. offsets:
// of the pixels, for dither (output.h), or null. out holds a register more than count, too. The
// sums are used up.
void resolve_pixels(PixelSums& sums, const Output& output, const image::Rgba8& background,
                    const float* offsets, int count, std::uint32_t* out);

// The same for all pixels of an area, row by row, into the picture.
void resolve_area(PixelSums& sums, const Output& output, const image::Rgba8& background,
                  const image::Rect& area, image::Image& picture);

// Every pixel of the area from scale x scale pixels of the larger picture, each counting alike.
// Returns whether any of them shows a primitive.
bool mean_of_boxes(LinearPicture& from, int scale, const image::Rect& area, PixelSums& sums);

} // namespace scanout::shade
