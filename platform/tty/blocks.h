// A picture as coloured half blocks, two to a cell, for terminals that show text alone; and text.
#pragma once

#include "image/image.h"
#include "port/display.h"

#include <span>
#include <string>
#include <vector>

namespace scanout::tty {

// Pixels of a half block, averaged in linear light. A cell is two of them: slightly less than a
// letter of the overlays measures, so that each of their lines has a row of its own.
inline constexpr int kHalfBlock = 7;
inline constexpr int kCellPixelsAcross = kHalfBlock, kCellPixelsDown = 2 * kHalfBlock;

struct Colour {
    std::uint8_t r = 0, g = 0, b = 0;
    friend bool operator==(const Colour&, const Colour&) = default;
};

struct Cell {
    std::string glyph; // UTF-8; empty: the upper half block
    Colour front, back;
    friend bool operator==(const Cell&, const Cell&) = default;
};

struct Cells {
    int columns = 0, rows = 0;
    std::vector<Cell> cells; // rows from the top
    Cell& at(int column, int row) {
        return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
    }
    const Cell& at(int column, int row) const { return const_cast<Cells*>(this)->at(column, row); }
};

// The picture measures kCellPixelsAcross x columns, kCellPixelsDown x rows.
Cells cells_of(const image::Image& image);
// Each letter in the cell where its middle is.
void put_text(Cells& cells, std::span<const port::TextLine> lines);

// Writes the cells that differ from those shown; all where the sizes differ. true_colour: 24 bits,
// else the nearest of xterm's 240 fixed colours.
std::string written(const Cells& cells, const Cells& shown, bool true_colour);

// The number of the nearest of xterm's colour cube and greys, 16 to 255; the lowest where two are.
int nearest_of_256(Colour colour);

} // namespace scanout::tty
