// The x-scanline method [Primer 4.2.1]: a line meets the edges, the crossings are sorted and
// paired, and what lies between a pair is filled. A vertex counts once where its edges lie on both
// sides of the line, else twice or not at all: an edge owns its upper end and not its lower one.
#include "textbook/fill/fill.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scanout::textbook {

void fill_x_scanline(const Points& p, const Span& span) {
    const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
    for (int y = static_cast<int>(std::ceil(top)); y < bottom; ++y) {
        std::vector<double> crossings;
        for (std::size_t i = 0; i < 3; ++i) {
            const DVec2 &a = p[i], &b = p[(i + 1) % 3];
            if (std::min(a.y, b.y) <= y && y < std::max(a.y, b.y))
                crossings.push_back(a.x + (y - a.y) * (b.x - a.x) / (b.y - a.y));
        }
        std::sort(crossings.begin(), crossings.end());
        for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
            span(y, static_cast<int>(std::ceil(crossings[i])),
                 static_cast<int>(std::ceil(crossings[i + 1])));
    }
}

} // namespace scanout::textbook
