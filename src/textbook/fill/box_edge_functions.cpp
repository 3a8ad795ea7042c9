// The box with edge functions, "ToLeft" [SoftwareGraphics], [Primer 4.2.3], Pineda 1988: a pixel is
// inside where it lies on one side of all three edges. The document says nothing of a point on an
// edge; the top-left rule gives it to one of the two triangles that share it.
#include "textbook/fill/fill.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scanout::textbook {

bool covers(const Points& p, double x, double y) {
    Points c = p;
    if (twice_area(c[0], c[1], c[2]) < 0) std::swap(c[1], c[2]); // clockwise
    for (std::size_t i = 0; i < 3; ++i) {
        const DVec2 &a = c[i], &b = c[(i + 1) % 3];
        const double side = twice_area(a, b, DVec2(x, y));
        const bool top_left = b.y < a.y || (b.y == a.y && b.x > a.x);
        if (side < 0 || (side == 0 && !top_left)) return false;
    }
    return true;
}

void fill_box_edge_functions(const Points& p, const Span& span) {
    if (twice_area(p[0], p[1], p[2]) == 0) return;
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [top, bottom] = std::minmax({p[0].y, p[1].y, p[2].y});
    for (int y = static_cast<int>(std::ceil(top)); y <= bottom; ++y)
        for_each_run(
            static_cast<int>(std::ceil(left)), static_cast<int>(std::floor(right)) + 1,
            [&](int x) { return covers(p, x, y); }, [&](int from, int end) { span(y, from, end); });
}

} // namespace scanout::textbook
