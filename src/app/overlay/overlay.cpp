#include "app/overlay/overlay.h"

#include "app/overlay/accuracy_overlay.h"
#include "app/overlay/text.h"
#include "app/overlay/text_block.h"
#include "app/view/mark.h"

#include <algorithm>

namespace scanout::app {
namespace {

void draw_in_the_middle(image::Image& picture, const std::vector<std::string>& lines, int scale) {
    const TextBlock block = block_of(lines, scale);
    draw_block(picture, lines, std::max(0, (picture.width() - block.width) / 2),
               std::max(0, (picture.height() - block.height) / 2), scale);
}

// Each line of the message, broken where it is too long.
std::vector<std::string> message_lines(std::string_view message, std::size_t letters) {
    std::vector<std::string> lines;
    while (!message.empty()) {
        const std::size_t end = std::min(message.find('\n'), message.size());
        for (std::string& line : broken_into_lines(message.substr(0, end), letters))
            lines.push_back(std::move(line));
        message.remove_prefix(std::min(end + 1, message.size()));
    }
    return lines;
}

// The information, and under it the page that is open. The first line of each is its heading.
void draw_left(image::Image& picture, const Overlay& overlay, int scale) {
    const std::size_t letters = letters_across(picture.width(), picture.height());
    std::vector<std::string> lines;
    std::vector<std::size_t> heads;
    for (const auto* const block :
         {&overlay.info, &overlay.explain, &overlay.doctor, &overlay.warnings}) {
        if (block->empty()) continue;
        if (!lines.empty()) lines.emplace_back();
        heads.push_back(lines.size());
        for (const std::string& line : *block) {
            if (text_width(line) <= static_cast<int>(letters) * kGlyphWidth) { // also an empty one
                lines.push_back(line);
                continue;
            }
            for (std::string& part : broken_into_lines(line, letters))
                lines.push_back(std::move(part));
        }
    }
    if (!lines.empty()) draw_block_with_heads(picture, lines, heads, 0, 0, scale);
}

// What keys open beside the information; nothing is made for what is closed.
void draw_panels(image::Image& picture, const Overlay& overlay, int scale) {
    if (overlay.frontier) {
        // Beside the information, or below it where there is no room.
        const TextBlock info = block_of(overlay.info, scale);
        const bool beside =
            overlay.info.empty() ||
            info.width + frontier_panel_width(*overlay.frontier, scale) <= picture.width();
        draw_frontier_panel(picture, *overlay.frontier, beside ? 0 : info.height, scale);
    }
    if (!overlay.legend && !overlay.split) return;
    int bottom = picture.height() - block_of({""}, scale).height; // above the message
    if (overlay.legend) bottom -= draw_error_legend(picture, *overlay.legend, bottom, scale);
    if (overlay.split) draw_split_names(picture, *overlay.split, bottom, scale);
}

} // namespace

std::size_t letters_across(int width, int height) {
    const int scale = text_scale(width, height);
    return static_cast<std::size_t>(
        std::max(1, (width - 2 * kBlockMargin * scale) / (kGlyphWidth * scale)));
}

std::size_t lines_down(int width, int height) {
    const int scale = text_scale(width, height);
    const int message = (kGlyphHeight + 2 * kBlockMargin) * scale;
    return static_cast<std::size_t>(
        std::max(1, (height - message - 2 * kBlockMargin * scale) / (kGlyphHeight * scale)));
}

void draw_overlay(image::Image& picture, const Overlay& overlay) {
    const int scale = text_scale(picture.width(), picture.height());
    if (overlay.split) draw_split_line(picture, overlay.split->x, scale);
    if (overlay.measured) draw_measured(picture, *overlay.measured, scale);
    if (overlay.mark) draw_mark(picture, *overlay.mark, scale);
    // The help sheet shows all states, and takes the room of the other lines.
    if (overlay.help.empty()) draw_left(picture, overlay, scale);
    if (!overlay.message.empty()) {
        const std::vector<std::string> lines =
            message_lines(overlay.message, letters_across(picture.width(), picture.height()));
        draw_block(picture, lines, 0, picture.height() - block_of(lines, scale).height, scale);
    }
    if (overlay.help.empty()) draw_panels(picture, overlay, scale);
    if (!overlay.notice.empty()) draw_in_the_middle(picture, overlay.notice, scale);
    if (!overlay.help.empty()) draw_help(picture, overlay.help, scale);
}

} // namespace scanout::app
