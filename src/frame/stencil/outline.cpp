// The outline of what is shown, the stencil's oldest use: the first pass marks the pixels of the
// model, the second draws where none is marked but one is near. Nothing of the model is drawn over.
// It comes after all tiles, since a tile does not see its neighbour's pixels.
#include "frame/stencil.h"

#include <algorithm>

namespace scanout::frame::stencil {
namespace {

constexpr image::Rgba8 kColour{255, 140, 0, 255}; // orange: on dark, grey and white backgrounds

static_assert(kOutlineWidth == 2, "the card says so");

// Pixels whose centres are at most the width apart: of the row that lies so far away, how many to
// each side.
constexpr int reach(int rows) {
    int columns = 0;
    while ((columns + 1) * (columns + 1) + rows * rows <= kOutlineWidth * kOutlineWidth)
        ++columns;
    return columns;
}

void show(const StencilBuffer& marks, int y, image::Image& picture) {
    const int width = marks.width();
    std::vector<std::uint8_t> near_mark;
    for (int dy = -kOutlineWidth; dy <= kOutlineWidth; ++dy) {
        if (y + dy < 0 || y + dy >= marks.height()) continue;
        const auto other = marks.row(y + dy);
        if (std::find(other.begin(), other.end(), 1) == other.end()) continue;
        near_mark.resize(static_cast<std::size_t>(width), 0);
        const int most = reach(dy);
        for (int dx = -most; dx <= most; ++dx)
            for (int x = std::max(0, -dx); x < std::min(width, width - dx); ++x)
                near_mark[static_cast<std::size_t>(x)] |= other[static_cast<std::size_t>(x + dx)];
    }
    const auto own = marks.row(y);
    const auto pixels = picture.row(y);
    for (std::size_t x = 0; x < near_mark.size(); ++x)
        if (near_mark[x] != 0 && own[x] == 0) pixels[x] = kColour;
}

} // namespace

extern const Stencil outline;
constinit const Stencil outline{{.axis = "stencil",
                                 .name = "outline",
                                 .blurb = "a line of 2 pixels round all that is shown",
                                 .source = "[C 1.6], in two passes",
                                 .kind = Kind::model},
                                Stencil::Marks::shown,
                                show};

} // namespace scanout::frame::stencil
