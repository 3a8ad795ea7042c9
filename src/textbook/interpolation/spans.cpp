#include "textbook/interpolation/spans.h"

#include <algorithm>
#include <cmath>

namespace scanout::textbook {
namespace {

Step scaled_difference(const Step& a, const Step& b, double scale) {
    Step out{(b.x - a.x) * scale, (b.one_over_w - a.one_over_w) * scale, {}};
    for (std::size_t i = 0; i < kValues; ++i)
        out.values[i] = (b.values[i] - a.values[i]) * scale;
    return out;
}

Step step_of(const Corner& c, bool divided) {
    Step s{c.x, divided ? 1 / c.w : 1, c.values};
    if (divided)
        for (double& v : s.values)
            v /= c.w;
    return s;
}

Step along(const Step& from, const Step& by, double t) {
    Step out{from.x + by.x * t, from.one_over_w + by.one_over_w * t, {}};
    for (std::size_t i = 0; i < kValues; ++i)
        out.values[i] = from.values[i] + by.values[i] * t;
    return out;
}

} // namespace

void Spans::add(Step& step, const Step& by) {
    step.x += by.x;
    step.one_over_w += by.one_over_w;
    for (std::size_t i = 0; i < kValues; ++i)
        step.values[i] += by.values[i];
}

Spans::Edge Spans::edge_between(const Corner& upper, const Corner& lower, const Step& from,
                                const Step& to) const {
    Edge e;
    const double height = lower.y - upper.y;
    e.first = static_cast<int>(std::ceil(upper.y - 0.5));
    e.last = std::max(e.first, static_cast<int>(std::ceil(lower.y - 0.5)) - 1);
    e.down = height > 0 ? scaled_difference(from, to, 1 / height) : Step{0, 0, {}};
    if (begins_ == BeginsAt::vertex) { // as the document has it
        e.first = e.row = static_cast<int>(std::floor(upper.y - 0.5));
        e.last = static_cast<int>(std::floor(lower.y - 0.5));
        e.at = e.begin = from;
        return e;
    }
    // The first line's centre, or the end of an edge that meets none.
    const double begins = std::clamp(e.first + 0.5 - upper.y, 0.0, std::max(height, 0.0));
    e.at = e.begin = along(from, e.down, begins);
    e.row = e.first;
    return e;
}

void Spans::Edge::go_to(int line) {
    line = std::clamp(line, first, last); // a fill may draw beyond the ends
    if (line < row) {
        at = begin;
        row = first;
    }
    for (; row < line; ++row)
        add(at, down);
}

Spans::Spans(const Triangle& triangle, bool divided, BeginsAt begins) : begins_(begins) {
    std::array<Corner, 3> c = triangle.corner;
    std::stable_sort(c.begin(), c.end(),
                     [](const Corner& a, const Corner& b) { return a.y < b.y; });
    const Step top = step_of(c[0], divided), middle = step_of(c[1], divided),
               bottom = step_of(c[2], divided);
    long_ = edge_between(c[0], c[2], top, bottom);
    upper_ = edge_between(c[0], c[1], top, middle);
    lower_ = edge_between(c[1], c[2], middle, bottom);
    middle_y_ = c[1].y;
}

std::pair<Step, Step> Spans::begin(int y, int x0) {
    Edge& other = y + 0.5 < middle_y_ ? upper_ : lower_;
    long_.go_to(y);
    other.go_to(y);
    const Step &a = long_.at, &b = other.at;
    const Step &left = a.x <= b.x ? a : b, &right = a.x <= b.x ? b : a;
    const double width = right.x - left.x;
    if (!(width > 0)) return {left, Step{0, 0, {}}};
    const Step dx = scaled_difference(left, right, 1 / width);
    // The document's line begins at (int)x with the values of x.
    const double begins = begins_ == BeginsAt::vertex ? std::floor(left.x - 0.5) : left.x - 0.5;
    return {along(left, dx, x0 - begins), dx};
}

} // namespace scanout::textbook
