#include "app/overlay/accuracy_overlay.h"

#include "app/overlay/text.h"
#include "app/overlay/text_block.h"
#include "image/heat_map.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

namespace scanout::app {
namespace {

constexpr std::array kMarked = {0, 1, 3, 7, 15, 31, 63, 127, 255}; // codes, evenly along the bar
constexpr int kBarHeight = 10, kMarkWidth = 30;                    // font pixels
constexpr int kLegendLetters = 41; // "drawn 255 255 255, reference 255 255 255"
constexpr int kNameLetters = 9;    // "reference": a narrower side cuts its name off

std::vector<std::string> broken(const std::vector<std::string>& lines, std::size_t letters) {
    std::vector<std::string> all;
    for (const std::string& line : lines) {
        if (line.empty()) all.emplace_back(); // keeps its place
        for (std::string& part : broken_into_lines(line, letters))
            all.push_back(std::move(part));
    }
    return all;
}

// The colours from no error to 255 codes, and under them the codes. A narrow picture has fewer.
void draw_bar(image::Image& picture, int x0, int y, int width, int scale) {
    for (int x = 0; x < width; ++x)
        fill(picture, {x0 + x, y, x0 + x + 1, y + kBarHeight * scale},
             image::heat_colour(static_cast<double>(x) / std::max(1, width - 1)));
    const int last = static_cast<int>(kMarked.size()) - 1;
    int every = 1;
    while (every < last && width * every / last < kMarkWidth * scale)
        every *= 2;
    for (int i = 0; i <= last; i += every) {
        const std::string digits = fmt::format("{}", kMarked[static_cast<std::size_t>(i)]);
        draw_text(picture, x0 + width * i / last - text_width(digits, scale) / 2,
                  y + kBarHeight * scale, digits, kBlockText, scale);
    }
}

} // namespace

int draw_error_legend(image::Image& picture, const ErrorLegend& legend, int bottom, int scale) {
    const int margin = kBlockMargin * scale, line = kGlyphHeight * scale;
    const std::vector<std::string> lines =
        broken(legend.lines, letters_across(picture.width(), picture.height()));
    const TextBlock text = block_of(lines, scale);
    if (!legend.has_map) {
        draw_block(picture, lines, picture.width() - text.width, bottom - text.height, scale);
        return text.height;
    }
    const int width = std::min(kLegendLetters * kGlyphWidth * scale + 2 * margin, picture.width());
    const int height = text.height + kBarHeight * scale + line;
    const int left = picture.width() - width, top = bottom - height;
    draw_panel(picture, {left, top, left + width, bottom}, kBlockPanel);
    draw_lines(picture, lines, left + margin, top + margin, scale);
    // A mark's digits are centred, so half of them stand out at either end.
    const int overhang = kMarkWidth / 2 * scale;
    draw_bar(picture, left + margin + overhang, top + text.height - margin,
             width - 2 * (margin + overhang), scale);
    return height;
}

void draw_split_line(image::Image& picture, int x, int scale) {
    // Two colours, of which one stands out against any picture.
    fill(picture, {x - scale, 0, x, picture.height()}, {0, 0, 0, 255});
    fill(picture, {x, 0, x + scale, picture.height()}, {255, 255, 255, 255});
}

void draw_split_names(image::Image& picture, const SplitLine& split, int bottom, int scale) {
    const auto lines_of = [&](const std::string& name, int room) {
        const int letters = (room - (2 * kBlockMargin + 1) * scale) / (kGlyphWidth * scale);
        return broken({name}, static_cast<std::size_t>(std::max(letters, kNameLetters)));
    };
    const std::vector<std::string> left = lines_of(split.left, split.x),
                                   right = lines_of(split.right, picture.width() - split.x);
    const TextBlock a = block_of(left, scale), b = block_of(right, scale);
    draw_block(picture, left, split.x - scale - a.width, bottom - a.height, scale);
    draw_block(picture, right, split.x + scale, bottom - b.height, scale);
}

} // namespace scanout::app
