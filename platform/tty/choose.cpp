#include "platform/tty/choose.h"

#include "platform/tty/blocks.h"
#include "platform/tty/kitty.h"
#include "platform/tty/sixel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scanout::tty {
namespace {

// The cell's size in pixels, as the terminal or else its line says it; 0: neither does.
void set_cell(Choice& choice, const Facts& facts, const WindowSize& window) {
    choice.cell_width = facts.cell_width;
    choice.cell_height = facts.cell_height;
    if (facts.cell_width == 0 && window.width >= window.columns && window.height >= window.rows) {
        choice.cell_width = window.width / window.columns;
        choice.cell_height = window.height / window.rows;
    }
}

// The factor for both sides of that many pixels: 1, or what leaves kMostPixels of them.
double within_bounds(std::int64_t width, std::int64_t height) {
    const auto most = static_cast<double>(kMostPixels);
    return std::min(1.0,
                    std::sqrt(most / static_cast<double>(width) / static_cast<double>(height)));
}

// Fewer cells where they would have too many pixels.
void cut_cells(Choice& choice) {
    const std::int64_t cell = std::int64_t{choice.cell_width} * choice.cell_height;
    const double factor = within_bounds(std::int64_t{choice.columns} * choice.cell_width,
                                        std::int64_t{choice.rows} * choice.cell_height);
    if (factor == 1) return;
    choice.rows =
        std::clamp(static_cast<int>(choice.rows * factor), 1, static_cast<int>(kMostPixels / cell));
    choice.columns = std::clamp(static_cast<int>(choice.columns * factor), 1,
                                static_cast<int>(kMostPixels / (cell * choice.rows)));
}

Choice kitty(Choice choice, bool tmux) {
    choice.protocol = Protocol::kitty;
    choice.through_tmux = tmux;
    if (tmux) {
        // The picture is fitted to its cells by the terminal behind tmux, whose cells may not be
        // known.
        choice.rows = std::min(choice.rows, kMostPlaceholders);
        if (choice.cell_width == 0) {
            choice.cell_width = 8;
            choice.cell_height = 16;
        }
    }
    const double width = static_cast<double>(choice.columns) * choice.cell_width;
    const double height = static_cast<double>(choice.rows) * choice.cell_height;
    const double factor = within_bounds(std::int64_t{choice.columns} * choice.cell_width,
                                        std::int64_t{choice.rows} * choice.cell_height);
    choice.scaled = factor < 1;
    choice.width = std::max(static_cast<int>(width * factor), 1);
    choice.height = std::max(static_cast<int>(height * factor), 1);
    return choice;
}

Choice sixel(Choice choice) {
    choice.protocol = Protocol::sixel;
    // The last row stays free: a picture that ends in it makes terminals scroll.
    choice.rows = std::max(choice.rows - 1, 1);
    cut_cells(choice);
    choice.width = choice.columns * choice.cell_width;
    const int height = choice.rows * choice.cell_height;
    choice.height = std::max(height / kRowsOfABand * kRowsOfABand, std::min(height, kRowsOfABand));
    return choice;
}

Choice blocks(Choice choice, std::string why) {
    choice.cell_width = kCellPixelsAcross;
    choice.cell_height = kCellPixelsDown;
    cut_cells(choice);
    choice.width = choice.columns * choice.cell_width;
    choice.height = choice.rows * choice.cell_height;
    choice.why = std::move(why);
    return choice;
}

std::string why_not_better(const Facts& facts, bool tmux) {
    if (!facts.refusal.empty())
        return "the terminal could not take kitty's picture: " + facts.refusal;
    if (!facts.answers) return "the terminal does not answer";
    if (facts.kitty || facts.sixel) return "the terminal does not say how large its cells are";
    return tmux
               ? "no picture gets through tmux (by `tmux set -p allow-passthrough on`, kitty's do; "
                 "from tmux 3.4 on, sixels)"
               : "the terminal has neither kitty's graphics nor sixel";
}

} // namespace

const char* name_of(const Choice& choice) {
    switch (choice.protocol) {
    case Protocol::kitty:
        return choice.through_tmux ? "kitty graphics through tmux" : "kitty graphics";
    case Protocol::sixel:
        return "sixels";
    default:
        return "half blocks";
    }
}

Result<Choice> choose(const Facts& facts, const WindowSize& window, Protocol asked, bool tmux) {
    TRY_VOID(check_size(window));                // it may have changed since the line was opened
    const bool refused = !facts.refusal.empty(); // a picture by kitty's protocol
    if (refused && asked == Protocol::kitty) asked = Protocol::automatic;
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
    if (asked == Protocol::kitty ||
        (asked == Protocol::automatic && facts.kitty && !refused && (cell || tmux)))
        return kitty(choice, tmux);
    if (asked == Protocol::sixel || (facts.sixel && cell)) {
        choice = sixel(std::move(choice));
        if (refused) choice.why = why_not_better(facts, tmux);
        return choice;
    }
    return blocks(choice, why_not_better(facts, tmux));
}

} // namespace scanout::tty
