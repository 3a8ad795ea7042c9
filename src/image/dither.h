// Ordered dither: the 8x8 thresholds that every quantisation uses, be it to the 8 bits of the back
// buffer or to the 4 to 7 of a display. Bayer 1973.
#pragma once

#include "base/technique.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace scanout::image {

// The rounding of light to the back buffer's 8 bits; displays of fewer bits are always dithered.
struct Dither {
    Technique card;
    bool ordered; // adds dither_offset instead of rounding to nearest
};
inline constexpr unsigned kDitherSide = 8;
inline constexpr unsigned kDitherSteps = kDitherSide * kDitherSide;

namespace detail {
// The threshold that the pixel (x, y) adds, in 64ths of a step, before a value is truncated to a
// whole step: the 64 pixels of a square add 0 to 63 each once, and neighbours differ much. Bayer's
// matrix: the bits of x ^ y and y interleaved, the lowest bit of the coordinates on top.
constexpr auto bayer() {
    std::array<std::array<std::uint8_t, kDitherSide>, kDitherSide> square{};
    for (unsigned y = 0; y < kDitherSide; ++y)
        for (unsigned x = 0; x < kDitherSide; ++x) {
            unsigned value = 0;
            for (unsigned digit = 0; digit < 3; ++digit)
                value = value << 2 | ((x ^ y) >> digit & 1u) << 1 | (y >> digit & 1u);
            square[y][x] = static_cast<std::uint8_t>(kDitherSteps - 1 - value);
        }
    return square;
}
inline constexpr auto kBayer = bayer();
} // namespace detail

// 0 to 63; x, y >= 0: a pixel of the picture.
constexpr unsigned dither_threshold(unsigned x, unsigned y) {
    return detail::kBayer[y % kDitherSide][x % kDitherSide];
}

// Replaces the 1/2 of rounding to nearest: in (0, 1), 1/2 on average. A value within 1/128 of a
// whole step is rounded to that step everywhere.
constexpr float dither_offset(unsigned x, unsigned y) {
    return (static_cast<float>(dither_threshold(x, y)) + 0.5F) / static_cast<float>(kDitherSteps);
}

} // namespace scanout::image
