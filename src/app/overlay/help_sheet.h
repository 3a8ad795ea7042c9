// The help sheet: what the keys do and how what they switch stands now, in sections; and its pages,
// which fit any screen.
#pragma once

#include "app/keys/key_map.h"
#include "app/view/viewer_state.h"
#include "image/image.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::app {

struct SheetRow {
    std::string keys, text, now; // now: the present state; empty: there is none
    friend bool operator==(const SheetRow&, const SheetRow&) = default;
};
struct SheetSection {
    std::string_view heading;
    std::vector<SheetRow> rows;
};

// From the table of actions.
std::vector<SheetSection> help_sheet(const ViewerState& state, const KeyMap& keys);

// A line of a column: a heading, or a row or a part of one.
struct SheetLine {
    std::string heading, keys, text, now;
    friend bool operator==(const SheetLine&, const SheetLine&) = default;
};
struct SheetColumn {
    std::vector<SheetLine> lines;
    std::size_t key_letters = 0, letters = 0; // of the keys, and of all
    friend bool operator==(const SheetColumn&, const SheetColumn&) = default;
};
struct HelpPage {
    std::vector<SheetColumn> columns; // none: the sheet is closed
    std::string footer;
    bool empty() const { return columns.empty(); }
    friend bool operator==(const HelpPage&, const HelpPage&) = default;
};

// The sheet in columns, on as many pages as a screen of so many letters and lines needs; nothing is
// cut off.
std::vector<HelpPage> help_pages(const std::vector<SheetSection>& sections, std::size_t letters,
                                 std::size_t lines);

// In the middle of the picture.
void draw_help(image::Image& picture, const HelpPage& page, int scale);

} // namespace scanout::app
