// How a terminal is drawn on, from what it said of itself.
#pragma once

#include "base/result.h"
#include "platform/tty/answers.h"
#include "platform/tty/line.h"

#include <string>

namespace scanout::tty {

enum class Protocol : unsigned char { automatic, kitty, sixel, blocks };

struct Choice {
    Protocol protocol = Protocol::blocks;
    bool through_tmux = false;           // kitty's picture stands on Unicode placeholders
    int columns = 0, rows = 0;           // of cells that the picture covers
    int cell_width = 0, cell_height = 0; // pixels of the picture
    int height = 0;                      // pixels; less than rows have, where sixel takes six rows
    std::string why;                     // there is nothing better; "" where there is
    int width() const { return columns * cell_width; }
    friend bool operator==(const Choice&, const Choice&) = default;
};

// Exit::no_display where what is asked for cannot be shown. `asked`: automatic takes the best.
Result<Choice> choose(const Facts& facts, const WindowSize& window, Protocol asked, bool tmux);

} // namespace scanout::tty
