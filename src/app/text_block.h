// Lines of text on a dark panel: what overlays are made of.
#pragma once

#include "image/image.h"

#include <string>
#include <string_view>
#include <vector>

namespace scanout::app {

inline constexpr image::Rgba8 kBlockText{235, 235, 235, 255}, kBlockPanel{0, 0, 0, 176};
inline constexpr int kBlockMargin = 6; // font pixels around a block of text

// Letters grow with the picture: twice as large from 2560x1920 on.
int text_scale(int width, int height);

struct TextBlock {
    int width, height; // pixels, with its margin
};
TextBlock block_of(const std::vector<std::string>& lines, int scale);

// `text` in lines of at most `letters` letters, broken at spaces where there are any.
std::vector<std::string> broken_into_lines(std::string_view text, std::size_t letters);

// The lines under each other, the first one's upper left corner at (x, y).
void draw_lines(image::Image& picture, const std::vector<std::string>& lines, int x, int y,
                int scale);

// With its upper left corner at (x, y).
void draw_block(image::Image& picture, const std::vector<std::string>& lines, int x, int y,
                int scale);

} // namespace scanout::app
