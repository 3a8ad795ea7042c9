// Flat-bottom and flat-top scan conversion [Compendium 2.2], [Course 4.1]: the triangle is cut at
// the height of its middle vertex; from there both sides move by 1/slope a line. As the document
// has it: lines from (int)y, pixels from (int)sx to x <= ex, both ends included, so that triangles
// with a common edge both draw it; no triangle whose area is under 1e-15; and sx, ex clamped to
// their edges' ends, because a near-horizontal edge moves by thousands of pixels a line.
#include "textbook/fill/fill.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scanout::textbook {
namespace {

// A side of a half: x where it begins and ends, and its step from line to line.
struct Side {
    double x, end, dx;
    Side(const DVec2& from, const DVec2& to)
        : x(from.x), end(to.x), dx((to.x - from.x) / (to.y - from.y)) {}
    void clamp() {
        if (dx < 0) x = std::max(x, end);
        if (dx > 0) x = std::min(x, end);
    }
};

void fill_half(double y0, double y1, Side left, Side right, bool clamped, const Span& span) {
    if (!(y0 < y1)) return;
    for (int y = static_cast<int>(y0); y <= static_cast<int>(y1); ++y) {
        if (clamped) {
            left.clamp();
            right.clamp();
        }
        span(y, static_cast<int>(left.x), static_cast<int>(std::floor(right.x)) + 1);
        left.x += left.dx;
        right.x += right.dx;
    }
}

void fill_halves(Points p, bool clamped, const Span& span) {
    if (std::abs(twice_area(p[0], p[1], p[2])) < 1e-15) return;
    std::stable_sort(p.begin(), p.end(), [](const DVec2& a, const DVec2& b) { return a.y < b.y; });
    const double t = (p[1].y - p[0].y) / (p[2].y - p[0].y);
    DVec2 left = p[1], right(p[0].x + (p[2].x - p[0].x) * t, p[1].y);
    if (left.x > right.x) std::swap(left, right);
    fill_half(p[0].y, p[1].y, {p[0], left}, {p[0], right}, clamped, span);
    fill_half(p[1].y, p[2].y, {left, p[2]}, {right, p[2]}, clamped, span);
}

} // namespace

void fill_flat_halves(const Points& p, const Span& span) {
    fill_halves(p, true, span);
}

void fill_flat_halves_unclamped(const Points& p, const Span& span) {
    fill_halves(p, false, span);
}

} // namespace scanout::textbook
