// How the help sheet stands on a screen: in columns, and on pages where one has no room.
#include "app/overlay/help_sheet.h"
#include "app/overlay/text.h"
#include "app/overlay/text_block.h"

#include <algorithm>

namespace scanout::app {
namespace {

constexpr std::size_t kColumnLetters = 46, kMostColumns = 4, kGap = 3;

// A heading with its first row, or a row: lines that stay together.
using LineGroup = std::vector<SheetLine>;

std::size_t widest_keys(const std::vector<SheetSection>& sections, std::size_t letters) {
    std::size_t widest = 0;
    for (const SheetSection& section : sections)
        for (const SheetRow& row : section.rows)
            widest = std::max(widest, row.keys.size());
    return std::min(widest, letters * 2 / 5);
}

// Keys beside the text, both broken into lines where they are too long; the state follows the text.
LineGroup group_of(const SheetRow& row, std::size_t key_letters, std::size_t letters) {
    const std::vector<std::string> keys = broken_into_lines(row.keys, key_letters);
    const std::size_t room = letters - key_letters - 2;
    LineGroup group;
    for (std::string& text : broken_into_lines(row.text, room))
        group.push_back({{}, {}, std::move(text), {}});
    if (!row.now.empty()) {
        std::vector<std::string> states = broken_into_lines(row.now, room);
        std::size_t first = 0;
        if (!group.empty() && group.back().text.size() + 1 + states[0].size() <= room)
            group.back().now = states[first++];
        for (; first < states.size(); ++first)
            group.push_back({{}, {}, {}, states[first]});
    }
    group.resize(std::max(group.size(), keys.size()));
    for (std::size_t i = 0; i < keys.size(); ++i)
        group[i].keys = keys[i];
    return group;
}

std::vector<LineGroup> groups_of(const std::vector<SheetSection>& sections, std::size_t key_letters,
                                 std::size_t letters) {
    std::vector<LineGroup> groups;
    for (const SheetSection& section : sections) {
        bool first = true;
        for (const SheetRow& row : section.rows) {
            LineGroup group = group_of(row, key_letters, letters);
            if (first) group.insert(group.begin(), {std::string(section.heading), {}, {}, {}});
            first = false;
            groups.push_back(std::move(group));
        }
    }
    return groups;
}

// Columns of at most so many lines. A blank line stands above a heading, but not on top.
std::vector<SheetColumn> columns_of(const std::vector<LineGroup>& groups, std::size_t lines) {
    std::vector<SheetColumn> columns(1);
    for (const LineGroup& group : groups) {
        const bool heading = !group.front().heading.empty();
        const std::size_t blank = heading && !columns.back().lines.empty() ? 1 : 0;
        if (!columns.back().lines.empty() &&
            columns.back().lines.size() + blank + group.size() > lines)
            columns.emplace_back();
        else if (blank != 0)
            columns.back().lines.emplace_back();
        for (const SheetLine& line : group) {
            if (columns.back().lines.size() == lines) columns.emplace_back();
            columns.back().lines.push_back(line);
        }
    }
    return columns;
}

// The fewest lines of a column with which the groups take no more columns than they have to.
std::vector<SheetColumn> balanced(const std::vector<LineGroup>& groups, std::size_t columns,
                                  std::size_t lines) {
    std::vector<SheetColumn> best = columns_of(groups, lines);
    if (best.size() > columns) return best;
    for (std::size_t fewer = lines; fewer-- > 1;) {
        std::vector<SheetColumn> next = columns_of(groups, fewer);
        if (next.size() > columns) break;
        best = std::move(next);
    }
    return best;
}

void measure(SheetColumn& column) {
    for (const SheetLine& line : column.lines)
        column.key_letters = std::max(column.key_letters, line.keys.size());
    for (const SheetLine& line : column.lines) {
        const std::size_t between = line.text.empty() || line.now.empty() ? 0 : 1;
        column.letters =
            std::max({column.letters, line.heading.size(),
                      column.key_letters + 2 + line.text.size() + between + line.now.size()});
    }
}

} // namespace

std::vector<HelpPage> help_pages(const std::vector<SheetSection>& sections, std::size_t letters,
                                 std::size_t lines) {
    const std::size_t across =
        std::clamp<std::size_t>((letters + kGap) / (kColumnLetters + kGap), 1, kMostColumns);
    const std::size_t wide =
        std::max<std::size_t>((letters + kGap) / across, kGap + 8) - kGap; // of a column
    const std::size_t key_letters = widest_keys(sections, wide);
    const std::vector<LineGroup> groups = groups_of(sections, key_letters, wide);
    const std::size_t high = std::max<std::size_t>(lines, 3) - 1; // over the footer
    std::vector<SheetColumn> columns = balanced(groups, across, high);
    std::vector<HelpPage> pages;
    for (SheetColumn& column : columns) {
        measure(column);
        if (pages.empty() || pages.back().columns.size() == across) pages.emplace_back();
        pages.back().columns.push_back(std::move(column));
    }
    for (std::size_t i = 0; i < pages.size(); ++i)
        pages[i].footer = page_footer(i + 1, pages.size());
    return pages;
}

void draw_help(image::Image& picture, const HelpPage& page, int scale) {
    const int letter = kGlyphWidth * scale, line = kGlyphHeight * scale,
              margin = kBlockMargin * scale;
    std::size_t letters = 0, lines = 0;
    for (const SheetColumn& column : page.columns) {
        letters += column.letters + (letters > 0 ? kGap : 0);
        lines = std::max(lines, column.lines.size());
    }
    letters = std::max(letters, page.footer.size());
    const int width = static_cast<int>(letters) * letter + 2 * margin,
              height = static_cast<int>(lines + 1) * line + 2 * margin;
    const int left = std::max(0, (picture.width() - width) / 2),
              top = std::max(0, (picture.height() - height) / 2);
    draw_panel(picture, {left, top, left + width, top + height}, kBlockPanel);
    int x = left + margin;
    for (const SheetColumn& column : page.columns) {
        int y = top + margin;
        const int text_x = x + static_cast<int>(column.key_letters + 2) * letter;
        for (const SheetLine& row : column.lines) {
            draw_text(picture, x, y, row.heading, kBlockAccent, scale, font_bold);
            draw_text(picture, x, y, row.keys, kBlockText, scale, font_bold);
            draw_text(picture, text_x, y, row.text, kBlockText, scale);
            const std::size_t between = row.text.empty() ? 0 : row.text.size() + 1;
            draw_text(picture, text_x + static_cast<int>(between) * letter, y, row.now,
                      kBlockAccent, scale);
            y += line;
        }
        x += static_cast<int>(column.letters + kGap) * letter;
    }
    draw_text(picture, left + margin, top + margin + static_cast<int>(lines) * line, page.footer,
              kBlockDim, scale);
}

} // namespace scanout::app
