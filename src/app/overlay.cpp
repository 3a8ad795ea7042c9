#include "app/overlay.h"

#include "app/accuracy_overlay.h"
#include "app/actions.h"
#include "app/mark.h"
#include "app/text.h"
#include "app/text_block.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::app {
namespace {

void draw_in_the_middle(image::Image& picture, const std::vector<std::string>& lines, int scale) {
    const TextBlock block = block_of(lines, scale);
    draw_block(picture, lines, std::max(0, (picture.width() - block.width) / 2),
               std::max(0, (picture.height() - block.height) / 2), scale);
}

// A message of one line is not broken, but cut at the picture's edge: it must not cover the model.
std::vector<std::string> message_lines(const std::string& message, std::size_t letters) {
    std::vector<std::string> lines;
    const std::size_t end = message.find('\n');
    lines.push_back(message.substr(0, end));
    if (end == std::string::npos) return lines;
    for (std::string& line : broken_into_lines(message.substr(end + 1), letters))
        lines.push_back(std::move(line));
    return lines;
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

std::vector<std::string> help_sheet(const ViewerState& state) {
    std::vector<std::string> lines;
    for (const ActionRow& row : action_rows()) {
        if (row.sheet.empty()) continue;
        const std::string now = row.state != nullptr ? row.state(state) : std::string();
        lines.push_back(fmt::format("{:<18} {:<26} {}", row.sheet, row.help, now));
    }
    return lines;
}

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
    std::vector<std::string> left = overlay.info;
    left.insert(left.end(), overlay.explain.begin(), overlay.explain.end());
    left.insert(left.end(), overlay.doctor.begin(), overlay.doctor.end());
    if (!left.empty() && overlay.help.empty()) draw_block(picture, left, 0, 0, scale);
    if (!overlay.message.empty()) {
        const std::vector<std::string> lines =
            message_lines(overlay.message, letters_across(picture.width(), picture.height()));
        draw_block(picture, lines, 0, picture.height() - block_of(lines, scale).height, scale);
    }
    if (overlay.help.empty()) draw_panels(picture, overlay, scale);
    if (!overlay.notice.empty()) draw_in_the_middle(picture, overlay.notice, scale);
    if (!overlay.help.empty()) draw_in_the_middle(picture, overlay.help, scale);
}

} // namespace scanout::app
