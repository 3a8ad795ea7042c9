#include "app/view/pointer.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace scanout::app {
namespace {

// # black, . white, blank: transparent. The tip is the first pixel of the first row.
constexpr std::array<std::string_view, 17> kArrow = {
    "#           ", //
    "##          ", //
    "#.#         ", //
    "#..#        ", //
    "#...#       ", //
    "#....#      ", //
    "#.....#     ", //
    "#......#    ", //
    "#.......#   ", //
    "#........#  ", //
    "#.........# ", //
    "#......#####", //
    "#...#..#    ", //
    "#..##...#   ", //
    "#.#  #..#   ", //
    "##   #...#  ", //
    "      ####  ", //
};
constexpr int kWidth = 12, kHeight = static_cast<int>(kArrow.size());

} // namespace

image::Rect pointer_area(int x, int y, int width, int height) {
    return {std::clamp(x, 0, width), std::clamp(y, 0, height), std::clamp(x + kWidth, 0, width),
            std::clamp(y + kHeight, 0, height)};
}

void draw_pointer(image::Image& picture, int x, int y) {
    const image::Rect area = pointer_area(x, y, picture.width(), picture.height());
    for (int row = area.y0; row < area.y1; ++row)
        for (int column = area.x0; column < area.x1; ++column) {
            const char dot =
                kArrow[static_cast<std::size_t>(row - y)][static_cast<std::size_t>(column - x)];
            if (dot == '#') picture.at(column, row) = {0, 0, 0, 255};
            if (dot == '.') picture.at(column, row) = {255, 255, 255, 255};
        }
}

} // namespace scanout::app
