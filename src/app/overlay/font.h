// The overlay's fonts: X11's "misc-fixed" (public domain: "Share and enjoy."), printable ASCII,
// Latin-1 and a few dozen symbols. scripts/make_font.py wrote the font_*.cpp files from Debian's
// xfonts-base.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace scanout::app {

struct Glyph {
    char32_t code;
    // The cell's pixels row by row without padding, the first one in the highest bit of the first
    // word.
    std::array<std::uint64_t, 4> bits;
};

struct Font {
    int width, height;             // of every cell, in pixels
    std::span<const Glyph> glyphs; // in the order of their codes

    const Glyph* find(char32_t code) const; // nullptr: the font has no such character
    bool ink(const Glyph& glyph, int x, int y) const {
        const auto i = static_cast<unsigned>(y * width + x);
        return (glyph.bits[i / 64] >> (63 - i % 64) & 1) != 0;
    }
};

extern const Font font_regular; // 9x15
extern const Font font_bold;    // 9x15; without the geometric shapes
extern const Font font_large;   // 10x20

} // namespace scanout::app
