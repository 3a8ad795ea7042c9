// The model's outline, the classic use of a stencil: the first pass marks the pixels of the model,
// the second draws the unmarked pixels near a marked one, so it draws over no pixel of the model.
// The second pass comes after all tiles, since a tile does not see its neighbour's pixels.
#include "frame/stencil.h"

#include <algorithm>
#include <array>

namespace scanout::frame::stencil {
namespace {

constexpr image::Rgba8 kColour{255, 140, 0, 255}; // orange: on dark, grey and white backgrounds

static_assert(kOutlineWidth == 2, "the card says so");

// Pixels whose centres are at most the outline's width apart: for a row at this distance, the
// number of pixels to each side.
constexpr int reach(int rows) {
    int columns = 0;
    while ((columns + 1) * (columns + 1) + rows * rows <= kOutlineWidth * kOutlineWidth)
        ++columns;
    return columns;
}

// The pixels of row y from x0 to x1, at most kPart of them.
constexpr int kPart = 256;
void show_part(const StencilBuffer& marks, int y, int x0, int x1, image::Image& picture) {
    std::array<std::uint8_t, kPart> near_mark{};
    bool any = false;
    for (int dy = -kOutlineWidth; dy <= kOutlineWidth; ++dy) {
        if (y + dy < 0 || y + dy >= marks.height()) continue;
        const int most = reach(dy);
        const int first = std::max(0, x0 - most);
        const int last = std::min(marks.width(), x1 + most);
        const auto other = marks.row(y + dy);
        if (std::find(other.begin() + first, other.begin() + last, 1) == other.begin() + last)
            continue;
        any = true;
        for (int dx = -most; dx <= most; ++dx)
            for (int x = std::max(x0, -dx); x < std::min(x1, marks.width() - dx); ++x)
                near_mark[static_cast<std::size_t>(x - x0)] |=
                    other[static_cast<std::size_t>(x + dx)];
    }
    if (!any) return;
    const auto own = marks.row(y);
    const auto pixels = picture.row(y);
    for (int x = x0; x < x1; ++x)
        if (near_mark[static_cast<std::size_t>(x - x0)] != 0 &&
            own[static_cast<std::size_t>(x)] == 0)
            pixels[static_cast<std::size_t>(x)] = kColour;
}

void show_outline(const StencilBuffer& marks, int y, image::Image& picture) {
    for (int x = 0; x < marks.width(); x += kPart)
        show_part(marks, y, x, std::min(x + kPart, marks.width()), picture);
}

} // namespace

extern const Stencil outline;
constinit const Stencil outline{{.axis = "stencil",
                                 .name = "outline",
                                 .blurb = "a line of 2 pixels round all that is shown",
                                 .source = "McReynolds and Blythe 2005",
                                 .kind = Kind::model},
                                Stencil::Marks::visible,
                                show_outline};

} // namespace scanout::frame::stencil
