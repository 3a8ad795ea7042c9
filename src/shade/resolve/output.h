// From a pixel's light to its code: how the samples of a pixel are summed (blend space) and how the
// sum becomes 8 bits (encoding). Stands at the end of a block and of a tile.
#pragma once

#include "base/technique.h"
#include "shade/stage.h"

#include <cstdint>
#include <span>
#include <string_view>

namespace scanout::shade {

// Pixels side by side. Arrays may be read and written up to a register beyond count (stage.h,
// kPaddedBlock).
struct Light {
    const float *red, *green, *blue;
    const std::int32_t* alpha = nullptr; // codes; null: all 255
    // What is added to the code before it is cut to a whole one (image/dither.h); null: nearest.
    const float* offset = nullptr;
};

struct Encoding {
    Technique card;
    float (*decode)(std::uint8_t code); // the light that has this code: of the background
    // out: image::Rgba8 in memory. Light is clamped to [0, 1]; NaN counts as 0.
    void (*encode)(const Light& light, int count, std::uint32_t* out);
};

struct BlendSpace {
    Technique card;
    // Writes what is summed into block.colour; null: the linear light that stands there.
    void (*enter)(ShadingBlock& block, const std::uint32_t* code);
    // Of the sum; null: the frame's encoding.
    const Encoding* encoding;
    float white = 1; // white in the sum
};

namespace encode {
extern const Encoding srgb;
}
namespace blend_space {
extern const BlendSpace linear;
}

struct Output {
    const Encoding* encoding = &encode::srgb;
    const BlendSpace* blend_space = &blend_space::linear;
    bool dither = false; // to 8 bits
    const Encoding& sum_encoding() const {
        return blend_space->encoding != nullptr ? *blend_space->encoding : *encoding;
    }
    friend bool operator==(const Output&, const Output&) = default;
};

} // namespace scanout::shade
