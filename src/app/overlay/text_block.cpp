#include "app/overlay/text_block.h"

#include "app/overlay/text.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::app {

int text_scale(int width, int height) {
    constexpr int kHeight = 540, kWidth = 360; // pixels of a picture for each step
    return std::max(1, std::min((height + kHeight / 2) / kHeight, width / kWidth));
}

TextBlock block_of(const std::vector<std::string>& lines, int scale) {
    int widest = 0;
    for (const std::string& line : lines)
        widest = std::max(widest, text_width(line, scale));
    return {widest + 2 * kBlockMargin * scale,
            (static_cast<int>(lines.size()) * kGlyphHeight + 2 * kBlockMargin) * scale};
}

std::vector<std::string> broken_into_lines(std::string_view text, std::size_t letters) {
    std::vector<std::string> lines;
    while (text.size() > std::max<std::size_t>(letters, 1)) {
        const std::size_t space = text.rfind(' ', letters);
        const bool fits = space != std::string_view::npos && space > 0;
        const std::size_t end = fits ? space : std::max<std::size_t>(letters, 1);
        lines.emplace_back(text.substr(0, end));
        text.remove_prefix(end + (fits ? 1 : 0));
    }
    if (!text.empty()) lines.emplace_back(text);
    return lines;
}

std::string page_footer(std::size_t page, std::size_t pages) {
    const char* const next = page < pages ? "the same key goes on" : "the same key closes";
    return pages == 1 ? next : fmt::format("page {} of {}: {}", page, pages, next);
}

void draw_lines(image::Image& picture, const std::vector<std::string>& lines, int x, int y,
                int scale) {
    for (const std::string& line : lines) {
        draw_text(picture, x, y, line, kBlockText, scale);
        y += kGlyphHeight * scale;
    }
}

void draw_block(image::Image& picture, const std::vector<std::string>& lines, int x, int y,
                int scale) {
    const TextBlock block = block_of(lines, scale);
    draw_panel(picture, {x, y, x + block.width, y + block.height}, kBlockPanel);
    draw_lines(picture, lines, x + kBlockMargin * scale, y + kBlockMargin * scale, scale);
}

void draw_block_with_heads(image::Image& picture, const std::vector<std::string>& lines,
                           const std::vector<std::size_t>& heads, int x, int y, int scale) {
    draw_block(picture, lines, x, y, scale);
    for (const std::size_t head : heads)
        draw_text(picture, x + kBlockMargin * scale,
                  y + (kBlockMargin + static_cast<int>(head) * kGlyphHeight) * scale, lines[head],
                  kBlockAccent, scale);
}

} // namespace scanout::app
