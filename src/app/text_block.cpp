#include "app/text_block.h"

#include "app/text.h"

#include <algorithm>

namespace scanout::app {

int text_scale(int width, int height) {
    return std::max(1, std::min(width / 640, height / 480) / 2);
}

TextBlock block_of(const std::vector<std::string>& lines, int scale) {
    int widest = 0;
    for (const std::string& line : lines)
        widest = std::max(widest, text_width(line, scale));
    return {widest + 2 * kBlockMargin * scale,
            (static_cast<int>(lines.size()) * kGlyphHeight + 2 * kBlockMargin) * scale};
}

void draw_block(image::Image& picture, const std::vector<std::string>& lines, int x, int y,
                int scale) {
    const TextBlock block = block_of(lines, scale);
    draw_panel(picture, {x, y, x + block.width, y + block.height}, kBlockPanel);
    int line_y = y + kBlockMargin * scale;
    for (const std::string& line : lines) {
        draw_text(picture, x + kBlockMargin * scale, line_y, line, kBlockText, scale);
        line_y += kGlyphHeight * scale;
    }
}

} // namespace scanout::app
