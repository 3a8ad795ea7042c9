// The x-scanline with active edges [Primer 4.2.2]: a line asks only the edges that it meets, and
// their crossings move by 1/k from line to line. The sum of steps is rounded at each: where a
// crossing should fall on a pixel exactly, it may miss it.
#include "textbook/fill/fill.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace scanout::textbook {
namespace {

struct ActiveEdge {
    int first, end; // lines first <= y < end
    double x, dx;   // its crossing with the next line; 1/k
};

std::vector<ActiveEdge> edge_table(const Points& p) {
    std::vector<ActiveEdge> edges;
    for (std::size_t i = 0; i < 3; ++i) {
        const DVec2 &a = p[i], &b = p[(i + 1) % 3];
        const DVec2 &upper = a.y < b.y ? a : b, &lower = a.y < b.y ? b : a;
        const int first = static_cast<int>(std::ceil(upper.y)),
                  end = static_cast<int>(std::ceil(lower.y));
        if (first >= end) continue; // it meets no line
        const double dx = (lower.x - upper.x) / (lower.y - upper.y);
        edges.push_back({first, end, upper.x + (first - upper.y) * dx, dx});
    }
    return edges;
}

} // namespace

void fill_active_edges(const Points& p, const Span& span) {
    std::vector<ActiveEdge> table = edge_table(p);
    std::sort(table.begin(), table.end(),
              [](const ActiveEdge& a, const ActiveEdge& b) { return a.first < b.first; });
    std::vector<ActiveEdge> active;
    auto next = table.begin();
    for (int y = table.empty() ? 0 : table.front().first; next != table.end() || !active.empty();
         ++y) {
        for (; next != table.end() && next->first == y; ++next)
            active.push_back(*next);
        active.erase(std::remove_if(active.begin(), active.end(),
                                    [&](const ActiveEdge& e) { return e.end == y; }),
                     active.end());
        std::sort(active.begin(), active.end(),
                  [](const ActiveEdge& a, const ActiveEdge& b) { return a.x < b.x; });
        for (std::size_t i = 0; i + 1 < active.size(); i += 2)
            span(y, static_cast<int>(std::ceil(active[i].x)),
                 static_cast<int>(std::ceil(active[i + 1].x)));
        for (ActiveEdge& edge : active)
            edge.x += edge.dx;
    }
}

} // namespace scanout::textbook
