// Lines of text on a dark panel: what overlays are made of.
#pragma once

#include "image/image.h"

#include <string>
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

// With its upper left corner at (x, y).
void draw_block(image::Image& picture, const std::vector<std::string>& lines, int x, int y,
                int scale);

} // namespace scanout::app
