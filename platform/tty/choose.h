// How a terminal is drawn on, from what it said of itself.
#pragma once

#include "base/result.h"
#include "platform/tty/answers.h"
#include "platform/tty/line.h"

#include <cstdint>
#include <string>

namespace scanout::tty {

enum class Protocol : unsigned char { automatic, kitty, sixel, blocks };

// Of the picture: as many as a screen of 5120x2880 has, and no more, however large a window the
// terminal tells of.
inline constexpr std::int64_t kMostPixels = 16'000'000;

struct Choice {
    Protocol protocol = Protocol::blocks;
    bool through_tmux = false;           // kitty's picture stands on Unicode placeholders
    int columns = 0, rows = 0;           // of cells that the picture covers
    int cell_width = 0, cell_height = 0; // pixels of the screen
    // Pixels of the picture: those of its cells; or fewer, where sixel takes six rows, and where
    // kitty is to scale it.
    int width = 0, height = 0;
    bool scaled = false;
    std::string why; // there is nothing better; "" where there is
    // What the picture covers: all of its rows, but for sixel.
    double rows_covered() const {
        return protocol == Protocol::sixel ? static_cast<double>(height) / cell_height : rows;
    }
    friend bool operator==(const Choice&, const Choice&) = default;
};

// "half blocks"
const char* name_of(const Choice& choice);

// Exit::no_display where what is asked for cannot be shown. `asked`: automatic takes the best, as
// does kitty where the terminal has refused a picture.
Result<Choice> choose(const Facts& facts, const WindowSize& window, Protocol asked, bool tmux);

} // namespace scanout::tty
