#include "platform/tty/blocks.h"

#include "math/srgb.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>
#include <utf8proc.h>

namespace scanout::tty {
namespace {

constexpr const char* kUpperHalf = "\u2580";

Colour average(const image::Image& image, int x0, int y0) {
    float r = 0, g = 0, b = 0;
    for (int y = y0; y < y0 + kHalfBlock; ++y)
        for (const image::Rgba8 p :
             image.row(y).subspan(static_cast<std::size_t>(x0), kHalfBlock)) {
            r += srgb_decode(p.r);
            g += srgb_decode(p.g);
            b += srgb_decode(p.b);
        }
    constexpr float kCount = kHalfBlock * kHalfBlock;
    return {srgb_encode(r / kCount), srgb_encode(g / kCount), srgb_encode(b / kCount)};
}

// Of the two halves of a cell that gets a letter.
Colour between(Colour a, Colour b) {
    const auto mean = [](std::uint8_t x, std::uint8_t y) {
        return srgb_encode((srgb_decode(x) + srgb_decode(y)) / 2);
    };
    return {mean(a.r, b.r), mean(a.g, b.g), mean(a.b, b.b)};
}

// Removes the character at the front; what has no cell of its own, or would control the terminal,
// is a question mark.
std::string take_character(std::string_view& text) {
    utf8proc_int32_t code = 0;
    const auto length = utf8proc_iterate(reinterpret_cast<const utf8proc_uint8_t*>(text.data()),
                                         static_cast<utf8proc_ssize_t>(text.size()), &code);
    const auto taken = static_cast<std::size_t>(std::max<utf8proc_ssize_t>(length, 1));
    const bool shown = length > 0 && utf8proc_charwidth(code) == 1;
    std::string character(shown ? text.substr(0, taken) : "?");
    text.remove_prefix(taken);
    return character;
}

std::string colour_sequence(int base, Colour c, bool true_colour) {
    return true_colour ? fmt::format("\x1b[{};2;{};{};{}m", base, c.r, c.g, c.b)
                       : fmt::format("\x1b[{};5;{}m", base, nearest_of_256(c));
}

constexpr int kFirstOfCube = 16, kFirstGrey = 232, kGreys = 24, kSteps = 6;
constexpr std::array<int, kSteps> kLevels = {0, 95, 135, 175, 215, 255};

int nearest_level(int code) {
    int best = 0;
    for (int i = 1; i < kSteps; ++i)
        if (std::abs(kLevels[static_cast<std::size_t>(i)] - code) <
            std::abs(kLevels[static_cast<std::size_t>(best)] - code))
            best = i;
    return best;
}

} // namespace

int nearest_of_256(Colour c) {
    const int r = nearest_level(c.r), g = nearest_level(c.g), b = nearest_level(c.b);
    const int grey = std::clamp(((c.r + c.g + c.b) / 3 - 3) / 10, 0, kGreys - 1);
    const auto distance = [&](int x, int y, int z) {
        return (x - c.r) * (x - c.r) + (y - c.g) * (y - c.g) + (z - c.b) * (z - c.b);
    };
    const auto level = [](int i) { return kLevels[static_cast<std::size_t>(i)]; };
    const int tone = 8 + 10 * grey;
    return distance(tone, tone, tone) < distance(level(r), level(g), level(b))
               ? kFirstGrey + grey
               : kFirstOfCube + kSteps * kSteps * r + kSteps * g + b;
}

Cells cells_of(const image::Image& image) {
    Cells cells{image.width() / kCellPixelsAcross, image.height() / kCellPixelsDown, {}};
    cells.cells.reserve(static_cast<std::size_t>(cells.columns) *
                        static_cast<std::size_t>(cells.rows));
    for (int row = 0; row < cells.rows; ++row)
        for (int column = 0; column < cells.columns; ++column) {
            const int x = column * kCellPixelsAcross, y = row * kCellPixelsDown;
            cells.cells.push_back({"", average(image, x, y), average(image, x, y + kHalfBlock)});
        }
    return cells;
}

void put_text(Cells& cells, std::span<const port::TextLine> lines) {
    for (const port::TextLine& line : lines) {
        const int row = (line.y + line.height / 2) / kCellPixelsDown;
        if (row < 0 || row >= cells.rows) continue;
        int column = line.x / kCellPixelsAcross;
        for (std::string_view text = line.text; !text.empty() && column < cells.columns; ++column) {
            std::string character = take_character(text);
            if (column < 0) continue;
            Cell& cell = cells.at(column, row);
            const Colour back = cell.glyph.empty() ? between(cell.front, cell.back) : cell.back;
            cell = {std::move(character), {line.colour.r, line.colour.g, line.colour.b}, back};
        }
    }
}

std::string written(const Cells& cells, const Cells& shown, bool true_colour) {
    const bool all = cells.columns != shown.columns || cells.rows != shown.rows;
    std::string out, front, back; // the colours that are set
    for (int row = 0; row < cells.rows; ++row) {
        int at = -1; // the column where the cursor stands
        for (int column = 0; column < cells.columns; ++column) {
            const Cell& cell = cells.at(column, row);
            if (!all && cell == shown.at(column, row)) continue;
            if (at != column) out += fmt::format("\x1b[{};{}H", row + 1, column + 1);
            at = column + 1;
            const std::string new_back = colour_sequence(48, cell.back, true_colour);
            if (new_back != back) out += back = new_back;
            if (cell.glyph.empty() && cell.front == cell.back) {
                out += ' ';
                continue;
            }
            const std::string new_front = colour_sequence(38, cell.front, true_colour);
            if (new_front != front) out += front = new_front;
            out += cell.glyph.empty() ? kUpperHalf : cell.glyph;
        }
    }
    return out.empty() ? out : out + "\x1b[m";
}

} // namespace scanout::tty
