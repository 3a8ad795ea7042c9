#include "platform/tty/choose.h"

#include "platform/tty/blocks.h"
#include "platform/tty/kitty.h"

#include <algorithm>

namespace scanout::tty {
namespace {

constexpr int kBand = 6; // rows of pixels in a row of sixels

// The cell's size in pixels, as the terminal or else its line says it; 0: neither does.
void set_cell(Choice& choice, const Facts& facts, const WindowSize& window) {
    choice.cell_width = facts.cell_width;
    choice.cell_height = facts.cell_height;
    if (facts.cell_width == 0 && window.width >= window.columns && window.height >= window.rows) {
        choice.cell_width = window.width / window.columns;
        choice.cell_height = window.height / window.rows;
    }
    choice.height = choice.rows * choice.cell_height;
}

Choice kitty(Choice choice, bool tmux) {
    choice.protocol = Protocol::kitty;
    choice.through_tmux = tmux;
    if (!tmux) return choice;
    // The picture is fitted to its cells by the terminal behind tmux, whose cells may not be known.
    choice.rows = std::min(choice.rows, kMostPlaceholders);
    if (choice.cell_width == 0) {
        choice.cell_width = 8;
        choice.cell_height = 16;
    }
    choice.height = choice.rows * choice.cell_height;
    return choice;
}

Choice sixel(Choice choice) {
    choice.protocol = Protocol::sixel;
    // The last row stays free: a picture that ends in it makes terminals scroll.
    choice.rows = std::max(choice.rows - 1, 1);
    const int height = choice.rows * choice.cell_height;
    choice.height = std::max(height / kBand * kBand, std::min(height, kBand));
    return choice;
}

Choice blocks(Choice choice, std::string why) {
    choice.cell_width = kCellPixelsAcross;
    choice.cell_height = kCellPixelsDown;
    choice.height = choice.rows * choice.cell_height;
    choice.why = std::move(why);
    return choice;
}

std::string why_blocks(const Facts& facts, bool tmux) {
    if (!facts.answers) return "the terminal does not answer";
    if (facts.kitty || facts.sixel) return "the terminal does not say how large its cells are";
    return tmux
               ? "no picture gets through tmux (by `tmux set -p allow-passthrough on`, kitty's do; "
                 "from tmux 3.4 on, sixels)"
               : "the terminal has neither kitty's graphics nor sixel";
}

} // namespace

Result<Choice> choose(const Facts& facts, const WindowSize& window, Protocol asked, bool tmux) {
    Choice choice;
    choice.columns = window.columns;
    choice.rows = window.rows;
    set_cell(choice, facts, window);
    const bool cell = choice.cell_width > 0;
    if (asked == Protocol::blocks) return blocks(choice, "");
    if (asked != Protocol::automatic && !cell && !(asked == Protocol::kitty && tmux))
        return fail(Exit::no_display,
                    "--terminal {}: the terminal does not say how large its cells are",
                    asked == Protocol::kitty ? "kitty" : "sixel");
    if (asked == Protocol::kitty || (asked == Protocol::automatic && facts.kitty && (cell || tmux)))
        return kitty(choice, tmux);
    if (asked == Protocol::sixel || (facts.sixel && cell)) return sixel(choice);
    return blocks(choice, why_blocks(facts, tmux));
}

} // namespace scanout::tty
