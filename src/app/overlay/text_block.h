// Lines of text on a dark panel: what overlays are made of.
#pragma once

#include "image/image.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::app {

// The panel hides what is under it, and one colour tells headings and present states.
inline constexpr image::Rgba8 kBlockText{235, 235, 235, 255}, kBlockDim{150, 156, 165, 255},
    kBlockAccent{255, 196, 64, 255}, kBlockPanel{22, 24, 28, 255};
inline constexpr int kBlockMargin = 6; // font pixels around a block of text

// Letters grow with the picture, so that they are read from a metre away: twice as large on a
// display of 1920x1080, four times on one of 3840x2160. A narrow picture keeps 38 in a line.
int text_scale(int width, int height);

struct TextBlock {
    int width, height; // pixels, with its margin
};
TextBlock block_of(const std::vector<std::string>& lines, int scale);

// `text` in lines of at most `letters` letters, broken at spaces where there are any.
std::vector<std::string> broken_into_lines(std::string_view text, std::size_t letters);

// The last line of a panel with pages, from 1 on: which one it is, and what the key that opened it
// does next.
std::string page_footer(std::size_t page, std::size_t pages);

// The lines under each other, the first one's upper left corner at (x, y).
void draw_lines(image::Image& picture, const std::vector<std::string>& lines, int x, int y,
                int scale);

// With its upper left corner at (x, y). draw_block_with_heads: the lines of these numbers are
// headings.
void draw_block(image::Image& picture, const std::vector<std::string>& lines, int x, int y,
                int scale);

void draw_block_with_heads(image::Image& picture, const std::vector<std::string>& lines,
                           const std::vector<std::size_t>& heads, int x, int y, int scale);

} // namespace scanout::app
