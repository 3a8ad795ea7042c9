#include "app/accuracy_overlay.h"

#include "app/text.h"
#include "app/text_block.h"
#include "image/heat_map.h"
#include "math/transcendental.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace scanout::app {
namespace {

constexpr std::array kMarked = {0, 1, 3, 7, 15, 31, 63, 127, 255}; // codes, evenly along the bar
constexpr int kBarHeight = 10, kMarkWidth = 30;                    // font pixels
constexpr int kBarWidth = kMarkWidth * (static_cast<int>(kMarked.size()) - 1);

void fill(image::Image& picture, int x0, int y0, int x1, int y1, image::Rgba8 colour) {
    x0 = std::max(x0, 0);
    x1 = std::min(x1, picture.width());
    for (int y = std::max(y0, 0); y < std::min(y1, picture.height()); ++y)
        for (int x = x0; x < x1; ++x)
            picture.at(x, y) = colour;
}

} // namespace

int draw_error_legend(image::Image& picture, const ErrorLegend& legend, int scale) {
    const int margin = kBlockMargin * scale, line = kGlyphHeight * scale;
    // A mark's digits are centred, so half of them stand out at either end.
    const int overhang = kMarkWidth / 2 * scale;
    const int width =
        std::max(kBarWidth * scale + 2 * overhang, text_width(legend.value, scale)) + 2 * margin;
    const int height = 2 * line + kBarHeight * scale + 2 * margin;
    const int left = picture.width() - width, top = picture.height() - height;
    draw_panel(picture, {left, top, left + width, top + height}, kBlockPanel);
    draw_text(picture, left + margin, top + margin, legend.value, kBlockText, scale);
    const int bar_x = left + margin + overhang, bar_y = top + margin + line;
    const int bar_width = kBarWidth * scale;
    for (int x = 0; x < bar_width; ++x)
        fill(picture, bar_x + x, bar_y, bar_x + x + 1, bar_y + kBarHeight * scale,
             image::heat_colour(static_cast<double>(x) / (bar_width - 1)));
    for (std::size_t i = 0; i < kMarked.size(); ++i) {
        const std::string digits = fmt::format("{}", kMarked[i]);
        const int x = bar_x + static_cast<int>(i) * kMarkWidth * scale;
        draw_text(picture, x - text_width(digits, scale) / 2, bar_y + kBarHeight * scale, digits,
                  kBlockText, scale);
    }
    return height;
}

void draw_split_line(image::Image& picture, const SplitLine& split, int above_end, int scale) {
    // Two colours, of which one stands out against any picture.
    fill(picture, split.x - scale, 0, split.x, picture.height(), {0, 0, 0, 255});
    fill(picture, split.x, 0, split.x + scale, picture.height(), {255, 255, 255, 255});
    const TextBlock left = block_of({split.left}, scale);
    const int y = picture.height() - above_end - left.height - scale;
    draw_block(picture, {split.left}, split.x - scale - left.width, y, scale);
    draw_block(picture, {split.right}, split.x + scale, y, scale);
}

} // namespace scanout::app
