// Liang and Barsky 1984 [Primer 1.4.5]: along the line's parameter t, the largest t where it enters
// a side and the least where it leaves one.
#include "textbook/clip/clip.h"

#include <algorithm>

namespace scanout::textbook {

std::optional<Segment> clip_liang_barsky(const Segment& line, const Box& box) {
    const DVec2 a = line.first, way = line.second - line.first;
    double enters = 0, leaves = 1;
    // Of the four sides: how fast the line leaves it, and how far its begin lies inside.
    const std::array<std::pair<double, double>, 4> sides = {{{-way.x, a.x - box.left},
                                                             {way.x, box.right - a.x},
                                                             {-way.y, a.y - box.top},
                                                             {way.y, box.bottom - a.y}}};
    for (const auto& [out, inside] : sides) {
        if (out == 0 && inside < 0) return std::nullopt; // along the side, outside
        if (out < 0) enters = std::max(enters, inside / out);
        if (out > 0) leaves = std::min(leaves, inside / out);
    }
    if (enters > leaves) return std::nullopt;
    return Segment{a + way * enters, a + way * leaves};
}

} // namespace scanout::textbook
