// Resolves pixels that several fragments, or fragments and the background, share: means of samples.
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
    // Scratch of resolve_area, kept for its memory.
    std::vector<std::uint32_t> codes;
    std::vector<float> offsets;
    // Makes room for count pixels, all zero, and one more register.
    void reset(std::size_t count);
};

// Colours are weighted by alpha, not premultiplied, as PNG and PAM want it: a translucent
// background does not dilute the primitive's colour. offsets: the pixels' dither (output.h), or
// null. out must hold a register more than count. Uses up the sums.
void resolve_pixels(PixelSums& sums, const Output& output, const image::Rgba8& background,
                    const float* offsets, int count, std::uint32_t* out);

// The same for all pixels of an area, row by row, into the picture.
void resolve_area(PixelSums& sums, const Output& output, const image::Rgba8& background,
                  const image::Rect& area, image::Image& picture);

// Averages scale x scale pixels of the larger picture, with equal weights, for every pixel of the
// area. Returns whether any of them shows a primitive.
bool mean_of_boxes(LinearPicture& from, int scale, const image::Rect& area, PixelSums& sums);

} // namespace scanout::shade
