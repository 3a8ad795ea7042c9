// The author's own variant of the x-scanline [Primer 4.2.2]: every pixel of the box, from left to
// right, against every edge. A pixel is inside where an odd number of edges has been passed.
#include "textbook/fill/fill.h"

#include <algorithm>
#include <cmath>

namespace scanout::textbook {
namespace {

// Edges at (x, y) or to its left. On a line that runs down, what lies to the right has an area
// below 0.
int edges_passed(const Points& p, int x, int y) {
    int passed = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const DVec2 &a = p[i], &b = p[(i + 1) % 3];
        const DVec2 &upper = a.y < b.y ? a : b, &lower = a.y < b.y ? b : a;
        if (upper.y <= y && y < lower.y && twice_area(upper, lower, DVec2(x, y)) <= 0) ++passed;
    }
    return passed;
}

} // namespace

void fill_box_all_edges(const Points& p, const Span& span) {
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
    for (int y = static_cast<int>(std::ceil(top)); y <= bottom; ++y)
        for_each_run(
            static_cast<int>(std::ceil(left)), static_cast<int>(std::floor(right)) + 1,
            [&](int x) { return edges_passed(p, x, y) % 2 == 1; },
            [&](int from, int end) { span(y, from, end); });
}

} // namespace scanout::textbook
