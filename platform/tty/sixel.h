// A picture as sixels (DEC STD 070, chapter 9): bands of six rows, at most 256 colours.
#pragma once

#include "image/image.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace scanout::tty {

inline constexpr int kRowsOfABand = 6; // of pixels in a row of sixels

// Few colours for many: boxes of colour space are cut in two at their mean, the one with the
// greatest square error first, along the channel with the greatest (Wan, Wong and Prusinkiewicz
// 1988). Colours stand in percent, as sixel has them.
struct Palette {
    struct Percent {
        std::uint8_t r = 0, g = 0, b = 0;
    };
    std::vector<Percent> colours;
    std::vector<std::uint8_t> of_bin; // the colour of each of 32 x 32 x 32 boxes
    std::uint8_t operator[](image::Rgba8 pixel) const {
        return of_bin[static_cast<std::size_t>((pixel.r >> 3) << 10 | (pixel.g >> 3) << 5 |
                                               pixel.b >> 3)];
    }
};
Palette palette_of(const image::Image& image, int most_colours);

// The whole sequence, with its upper left corner at the cursor. most_colours: 2 to 256.
std::string sixel_picture(const image::Image& image, int most_colours);

} // namespace scanout::tty
