// kitty's graphics protocol (sw.kovidgoyal.net/kitty/graphics-protocol): a picture as zlib-packed
// RGB, lossless.
#pragma once

#include "image/image.h"

#include <string>

namespace scanout::tty {

// Shows the picture with its upper left corner at the cursor, which stays; under an id that no
// other picture has. The terminal answers when it has read it. columns and rows: it is scaled to
// that many cells; 0: it has the pixels of the screen.
std::string kitty_picture(const image::Image& image, unsigned id, int columns = 0, int rows = 0);

// The same through tmux, on columns x rows cells of Unicode placeholders, which tmux moves as text:
// the picture for the terminal behind it, and the text. Nothing is answered. At most
// kMostPlaceholders rows are shown.
inline constexpr int kMostPlaceholders = 243;
std::string kitty_placeholders(const image::Image& image, unsigned id, int columns, int rows);

// Takes it off the screen and out of the terminal's memory. Nothing is answered.
std::string kitty_delete(unsigned id);

} // namespace scanout::tty
