// Wu 1991: two pixels a step share the line by their distance from it, so that its edge is smooth.
#include "textbook/line/line.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace scanout::textbook {

void line_wu(Pixel a, Pixel b, const Plot& plot) {
    const bool steep = std::abs(b.y - a.y) > std::abs(b.x - a.x);
    if (steep) {
        std::swap(a.x, a.y);
        std::swap(b.x, b.y);
    }
    if (a.x > b.x) std::swap(a, b);
    const int rise = b.y - a.y, run = std::max(b.x - a.x, 1);
    for (int x = a.x; x <= b.x; ++x) {
        const double y = a.y + static_cast<double>(x - a.x) * rise / run;
        const int below = static_cast<int>(std::floor(y));
        const double share = y - below;
        for (const auto& [row, part] : {std::pair{below, 1 - share}, {below + 1, share}})
            if (part > 0) steep ? plot(row, x, part) : plot(x, row, part);
    }
}

} // namespace scanout::textbook
