#include "app/overlay/text.h"

#include "base/check.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace scanout::app {

using image::Image;
using image::Rect;
using image::Rgba8;

const Glyph* Font::find(char32_t code) const {
    const auto at = std::lower_bound(glyphs.begin(), glyphs.end(), code,
                                     [](const Glyph& glyph, char32_t c) { return glyph.code < c; });
    return at != glyphs.end() && at->code == code ? &*at : nullptr;
}

char32_t take_code(std::string_view& text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned char lead = byte(0);
    const auto ones = static_cast<std::size_t>(std::countl_one(lead)); // 0, or the length in bytes
    const std::size_t length = ones == 0 ? 1 : ones;
    char32_t code = ones == 0 ? lead : lead & (0x7fu >> ones);
    bool whole = ones == 0 || (ones >= 2 && ones <= 4 && text.size() >= ones);
    for (std::size_t i = 1; whole && i < length; ++i) {
        whole = (byte(i) & 0xc0u) == 0x80u;
        code = code << 6 | (byte(i) & 0x3fu);
    }
    constexpr std::array<char32_t, 5> kSmallest{0, 0, 0x80, 0x800, 0x10000};
    if (!whole || code < kSmallest[ones] || code > 0x10ffff || (code >= 0xd800 && code <= 0xdfff)) {
        text.remove_prefix(1);
        return kBroken;
    }
    text.remove_prefix(length);
    return code;
}

namespace {

// The outline box that stands for a missing character, one font pixel inside the cell.
bool box_ink(const Font& font, int x, int y) {
    const int right = font.width - 2, bottom = font.height - 2;
    if (x < 1 || y < 1 || x > right || y > bottom) return false;
    return x == 1 || y == 1 || x == right || y == bottom;
}

// The part of [begin, begin + size) inside [0, end), in 64 bits: text may lie anywhere.
struct Span {
    Span(std::int64_t begin, std::int64_t size, int end)
        : first(static_cast<int>(std::clamp<std::int64_t>(begin, 0, end))),
          last(static_cast<int>(std::clamp<std::int64_t>(begin + size, 0, end))) {}
    int first, last;
};

Rect clipped(const Image& image, std::int64_t x, std::int64_t y, std::int64_t width,
             std::int64_t height) {
    const Span across(x, width, image.width()), down(y, height, image.height());
    if (across.first >= across.last || down.first >= down.last) return {};
    return {across.first, down.first, across.last, down.last};
}

thread_local LetterCollector* letter_collector = nullptr;

void draw_cell(Image& image, std::int64_t x, std::int64_t y, const Font& font, const Glyph* glyph,
               Rgba8 colour, int scale) {
    const Rect area =
        clipped(image, x, y, std::int64_t{font.width} * scale, std::int64_t{font.height} * scale);
    for (int py = area.y0; py < area.y1; ++py) {
        const int row = static_cast<int>((py - y) / scale);
        for (int px = area.x0; px < area.x1; ++px) {
            const int column = static_cast<int>((px - x) / scale);
            if (glyph != nullptr ? font.ink(*glyph, column, row) : box_ink(font, column, row))
                image.at(px, py) = colour;
        }
    }
}

} // namespace

LetterCollector::LetterCollector() {
    letter_collector = this;
}
LetterCollector::~LetterCollector() {
    letter_collector = nullptr;
}

int text_width(std::string_view utf8, int scale, const Font& font) {
    std::int64_t cells = 0;
    for (; !utf8.empty(); ++cells)
        take_code(utf8);
    const std::int64_t width = cells * font.width * scale;
    return static_cast<int>(std::min<std::int64_t>(width, std::numeric_limits<int>::max()));
}

Rect draw_text(Image& image, int x, int y, std::string_view utf8, Rgba8 colour, int scale,
               const Font& font) {
    CHECK_GE(scale, 1);
    if (letter_collector != nullptr) {
        letter_collector->add({x, y, font.height * scale, std::string(utf8), colour});
        return clipped(image, x, y, std::int64_t{text_width(utf8, scale, font)},
                       std::int64_t{font.height} * scale);
    }
    std::int64_t at = x;
    while (!utf8.empty()) {
        const char32_t code = take_code(utf8);
        draw_cell(image, at, y, font, font.find(code), colour, scale);
        at += std::int64_t{font.width} * scale;
    }
    return clipped(image, x, y, at - x, std::int64_t{font.height} * scale);
}

Rect draw_panel(Image& image, const Rect& area, Rgba8 colour) {
    if (area.empty()) return {};
    const Rect inside = clipped(image, area.x0, area.y0, std::int64_t{area.x1} - area.x0,
                                std::int64_t{area.y1} - area.y0);
    const auto mix = [&](std::uint8_t under, std::uint8_t over) {
        return static_cast<std::uint8_t>((under * (255 - colour.a) + over * colour.a + 127) / 255);
    };
    for (int y = inside.y0; y < inside.y1; ++y)
        for (Rgba8& pixel : image.row(y).subspan(static_cast<std::size_t>(inside.x0),
                                                 static_cast<std::size_t>(inside.width())))
            pixel = {mix(pixel.r, colour.r), mix(pixel.g, colour.g), mix(pixel.b, colour.b),
                     pixel.a};
    return inside;
}

void fill(Image& image, const Rect& area, Rgba8 colour) {
    for (int y = std::max(area.y0, 0); y < std::min(area.y1, image.height()); ++y)
        for (int x = std::max(area.x0, 0); x < std::min(area.x1, image.width()); ++x)
            image.at(x, y) = colour;
}

} // namespace scanout::app
