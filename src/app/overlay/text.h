// Text and panels on top of a finished picture. Everything is clipped to the picture.
#pragma once

#include "app/overlay/font.h"
#include "image/image.h"
#include "port/display.h"

#include <string_view>
#include <utility>
#include <vector>

namespace scanout::app {

// The cell of font_regular and font_bold at scale 1.
constexpr int kGlyphWidth = 9;
constexpr int kGlyphHeight = 15;

// Removes one code point from the front of a text that is not empty; where that is no UTF-8, one
// byte, and returns kBroken (Unicode 2022, 3.9, D92).
constexpr char32_t kBroken = 0xfffd;
char32_t take_code(std::string_view& text);

// Pixels from the left of the first cell to the right of the last. One cell a code point; a byte
// that is not UTF-8 is a cell of its own.
int text_width(std::string_view utf8, int scale = 1, const Font& font = font_regular);

// Draws one line with its upper left corner at (x, y), each font pixel as scale x scale pixels of
// exactly `colour`; the background stays. Control characters, broken UTF-8 and characters that the
// font lacks become boxes. Returns the line's cells clipped to the picture; no pixel outside is
// touched. scale >= 1.
image::Rect draw_text(image::Image& image, int x, int y, std::string_view utf8, image::Rgba8 colour,
                      int scale = 1, const Font& font = font_regular);

// While it lives, draw_text() of this thread draws no letters: it notes them, for a display that
// has letters of its own. One at a time.
class LetterCollector {
public:
    LetterCollector();
    LetterCollector(const LetterCollector&) = delete;
    LetterCollector& operator=(const LetterCollector&) = delete;
    ~LetterCollector();
    void add(port::TextLine line) { lines_.push_back(std::move(line)); }
    std::vector<port::TextLine> take() { return std::move(lines_); }

private:
    std::vector<port::TextLine> lines_;
};

// Lays `colour` over the rectangle with colour.a / 255 as its weight (black with a = 160 darkens):
// each channel is the rounded mean of the codes, alpha is left alone. Returns the rectangle
// clipped.
image::Rect draw_panel(image::Image& image, const image::Rect& area, image::Rgba8 colour);

// Each pixel of the rectangle that lies in the picture becomes `colour`, alpha as well.
void fill(image::Image& image, const image::Rect& area, image::Rgba8 colour);

} // namespace scanout::app
