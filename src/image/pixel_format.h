// The pixel layouts of displays: any channel offsets and widths in 16, 24 or 32 bits, little
// endian. One function turns the back buffer into the bytes of a display, for every display and for
// `render --pixel-format` alike.
#pragma once

#include "base/result.h"
#include "image/image.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::image {

struct Channel {
    int offset = 0; // bit of the lowest digit
    int bits = 0;   // 0: the display has no such channel
    friend bool operator==(const Channel&, const Channel&) = default;
};

struct PixelFormat {
    int bits_per_pixel = 32; // 16, 24 or 32
    Channel red{16, 8}, green{8, 8}, blue{0, 8}, alpha{24, 0};
    int bytes_per_pixel() const { return bits_per_pixel / 8; }
    friend bool operator==(const PixelFormat&, const PixelFormat&) = default;
};

// xrgb8888 xbgr8888 argb8888 rgb888 bgr888 rgb565 bgr565 xrgb1555 rgba8888 ...; the command line's
// names.
struct NamedPixelFormat {
    std::string_view name;
    PixelFormat format;
};
std::span<const NamedPixelFormat> pixel_formats();
Result<PixelFormat> pixel_format(std::string_view name); // Exit::usage with the list of names
std::string name_of(const PixelFormat& format);          // a listed name, or offsets in words

// Can this layout be written? (16, 24 or 32 bits; red, green and blue of 4 to 8 bits and alpha of 0
// to 8 inside the pixel, without overlap.) Errors: Exit::no_display, since displays bring odd
// layouts.
Result<void> check(const PixelFormat& format);

// Writes a row, or a part of one, whose first pixel stands at (x0, y) in the picture, both >= 0:
// the same pixel at the same place gives the same bytes, whatever part is written. Channels of 8
// bits keep their codes; narrower ones get an 8x8 ordered dither (dither.h) between the two nearest
// codes that decode_row() shows: a code that it can show is exact, so black, white and text stay
// clean. Unused bits are 0, alpha is full. out holds at least row.size() * bytes_per_pixel() bytes.
void encode_row(const PixelFormat& format, std::span<const Rgba8> row, int x0, int y,
                std::uint8_t* out);
// The display's picture of those bytes: channels widened to 8 bits by repeating their upper digits,
// alpha 255. Both functions take formats that check() passed.
void decode_row(const PixelFormat& format, const std::uint8_t* in, std::span<Rgba8> row);

// encode then decode: the picture as the display shows it.
Image as_displayed(const PixelFormat& format, const Image& image);
// Without dither: every code becomes the nearest that the display shows (the lower one where two
// are as near), which encode_row() then keeps. Alpha stays as it is.
Image without_dither(const PixelFormat& format, const Image& image);
int min_bits(const PixelFormat& format); // of red, green and blue

} // namespace scanout::image
