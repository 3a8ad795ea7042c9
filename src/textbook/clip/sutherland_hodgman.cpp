// Sutherland and Hodgman 1974 [Primer 1.4.5]: a polygon against each side of a convex window in
// turn.
#include "textbook/clip/clip.h"

namespace scanout::textbook {

std::vector<Corner> clip_sutherland_hodgman(std::vector<Corner> polygon,
                                            const std::vector<DVec2>& window) {
    for (std::size_t side = 0; side < window.size(); ++side) {
        const DVec2 &from = window[side], &to = window[(side + 1) % window.size()];
        polygon = clip_by_side(
            polygon, [&](const Corner& c) { return twice_area(from, to, DVec2(c.x, c.y)); });
    }
    return polygon;
}

} // namespace scanout::textbook
