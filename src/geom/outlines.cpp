#include "geom/outlines.h"

#include "math/predicates.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace scanout::geom {
namespace {

constexpr std::uint32_t kNone = 0xffffffff;

// A loop on the way from edges to polygons.
struct Traced {
    Loop loop;
    double area = 0;   // above 0: counter-clockwise
    int direction = 0; // 1 as its edges run, -1 against them; 0: they run both ways
    DVec2 low{0}, high{0};
};

// Follows edges from point to point.
class Tracer {
public:
    Tracer(std::span<const DVec2> points, std::span<const OutlineEdge> edges)
        : points_(points), edges_(edges), used_(edges.size(), 0), begin_(points.size() + 1, 0),
          at_(edges.size() * 2) {
        for (const OutlineEdge& e : edges) {
            ++begin_[e.from + 1];
            ++begin_[e.to + 1];
        }
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        for (std::uint32_t e = 0; e < edges.size(); ++e) {
            at_[next[edges[e].from]++] = e;
            at_[next[edges[e].to]++] = e;
        }
    }

    std::vector<Traced> run(std::size_t& open_edges) {
        std::vector<Traced> loops;
        for (std::uint32_t e = 0; e < edges_.size(); ++e) {
            if (used_[e] != 0) continue;
            Traced traced;
            const std::size_t steps = trace(e, traced);
            if (!closed_)
                open_edges += steps;
            else if (traced.loop.points.size() >= 3)
                loops.push_back(std::move(traced));
        }
        return loops;
    }

private:
    std::uint32_t other_end(std::uint32_t edge, std::uint32_t point) const {
        return edges_[edge].from == point ? edges_[edge].to : edges_[edge].from;
    }

    // Returns the number of edges that it went along.
    std::size_t trace(std::uint32_t first, Traced& traced) {
        std::uint32_t edge = first, point = edges_[first].from;
        std::size_t steps = 0, forward = 0;
        closed_ = false;
        do {
            forward += edges_[edge].from == point ? 1 : 0;
            traced.loop.points.push_back(point);
            ++steps;
            const std::uint32_t before = std::exchange(point, other_end(edge, point));
            used_[edge] = 1;
            edge = next(first, point, before);
        } while (edge != kNone && edge != first);
        closed_ = edge == first;
        traced.direction = forward == steps ? 1 : forward == 0 ? -1 : 0;
        return steps;
    }

    // The edge that goes on from a point: of several the first in clockwise order from the one that
    // leads to it, among those that run the right way if some do. So the inside, which lies to the
    // left, is not crossed.
    std::uint32_t next(std::uint32_t first, std::uint32_t point, std::uint32_t before) const {
        std::uint32_t best = kNone;
        for (std::uint32_t i = begin_[point]; i < begin_[point + 1]; ++i) {
            const std::uint32_t e = at_[i];
            if (used_[e] != 0 && e != first) continue;
            if (e == first && edges_[first].from != point) continue;
            if (best == kNone) {
                best = e;
                continue;
            }
            const bool runs = edges_[e].from == point, best_runs = edges_[best].from == point;
            if (runs != best_runs
                    ? runs
                    : comes_first(point, before, other_end(e, point), other_end(best, point)))
                best = e;
        }
        return best;
    }

    // Clockwise about `point` from `zero`: is a before b?
    bool comes_first(std::uint32_t point, std::uint32_t zero, std::uint32_t a,
                     std::uint32_t b) const {
        const DVec2 &p = points_[point], &z = points_[zero], &pa = points_[a], &pb = points_[b];
        const auto half = [&](const DVec2& q) { // 0: to the right of zero, 1: opposite, 2: left
            const int turn = orient2d(p, z, q);
            if (turn != 0) return turn < 0 ? 0 : 2;
            const bool same = dot(z - p, q - p) > 0;
            return same ? 3 : 1;
        };
        const int of_a = half(pa), of_b = half(pb);
        return of_a != of_b ? of_a < of_b : orient2d(p, pa, pb) < 0;
    }
    static double dot(const DVec2& a, const DVec2& b) { return a.x * b.x + a.y * b.y; }

    std::span<const DVec2> points_;
    std::span<const OutlineEdge> edges_;
    std::vector<std::uint8_t> used_;
    std::vector<std::uint32_t> begin_, at_; // edges at each point
    bool closed_ = false;
};

void measure(std::span<const DVec2> points, Traced& t) {
    const DVec2 origin = points[t.loop.points.front()];
    t.low = t.high = origin;
    const std::size_t n = t.loop.points.size();
    for (std::size_t i = 0; i < n; ++i) {
        const DVec2 a = points[t.loop.points[i]] - origin;
        const DVec2 b = points[t.loop.points[i + 1 < n ? i + 1 : 0]] - origin;
        t.area += (a.x * b.y - a.y * b.x) * 0.5;
        const DVec2& p = points[t.loop.points[i]];
        t.low = {std::min(t.low.x, p.x), std::min(t.low.y, p.y)};
        t.high = {std::max(t.high.x, p.x), std::max(t.high.y, p.y)};
    }
}

enum class Place { outside, border, inside };

Place place_in(std::span<const DVec2> points, const Loop& loop, const DVec2& p) {
    bool inside = false;
    const std::size_t n = loop.points.size();
    for (std::size_t i = 0; i < n; ++i) {
        const DVec2& a = points[loop.points[i]];
        const DVec2& b = points[loop.points[i + 1 < n ? i + 1 : 0]];
        if (p == a) return Place::border;
        const bool a_above = a.y > p.y, b_above = b.y > p.y;
        if (a_above == b_above) {
            const bool level = a.y == p.y && b.y == p.y;
            if (level && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x))
                return Place::border;
            if (a.y > p.y || b.y > p.y || (a.y < p.y && b.y < p.y) || level) continue;
        }
        const int turn = orient2d(a, b, p);
        const bool within = std::min(a.y, b.y) <= p.y && p.y <= std::max(a.y, b.y);
        if (turn == 0 && within) return Place::border;
        if (a_above != b_above && (turn > 0) == b_above) inside = !inside;
    }
    return inside ? Place::inside : Place::outside;
}

bool lies_in(std::span<const DVec2> points, const Traced& a, const Traced& b) {
    if (a.low.x < b.low.x || a.low.y < b.low.y || a.high.x > b.high.x || a.high.y > b.high.y)
        return false;
    const std::vector<std::uint32_t>& of_a = a.loop.points;
    for (const std::uint32_t p : of_a)
        if (const Place place = place_in(points, b.loop, points[p]); place != Place::border)
            return place == Place::inside;
    for (std::size_t i = 0; i < of_a.size(); ++i) {
        const DVec2 middle = (points[of_a[i]] + points[of_a[(i + 1) % of_a.size()]]) * 0.5;
        if (const Place place = place_in(points, b.loop, middle); place != Place::border)
            return place == Place::inside;
    }
    return false;
}

void turn(Traced& t) {
    std::reverse(t.loop.points.begin(), t.loop.points.end());
    t.area = -t.area;
}

// From the largest to the smallest: a loop's surroundings are known before it is.
std::vector<Polygon> nest(std::span<const DVec2> points, std::vector<Traced> loops) {
    std::stable_sort(loops.begin(), loops.end(), [](const Traced& a, const Traced& b) {
        return std::abs(a.area) > std::abs(b.area);
    });
    std::vector<Polygon> polygons;
    std::vector<std::uint32_t> polygon_of(loops.size(), kNone); // of outlines
    for (std::size_t i = 0; i < loops.size(); ++i) {
        Traced& t = loops[i];
        std::size_t around = loops.size(); // the smallest loop around it
        for (std::size_t j = i; j-- > 0 && around == loops.size();)
            if (lies_in(points, t, loops[j])) around = j;
        const bool in_outline = around < loops.size() && polygon_of[around] != kNone;
        const bool clockwise = t.area * t.direction < 0;
        if (in_outline &&
            (t.direction == 0 || clockwise != polygons[polygon_of[around]].outline.turned)) {
            if (t.area > 0) turn(t);
            polygons[polygon_of[around]].holes.push_back(t.loop);
            continue;
        }
        if (t.area < 0) turn(t);
        polygon_of[i] = static_cast<std::uint32_t>(polygons.size());
        t.loop.turned = clockwise;
        polygons.push_back({t.loop, {}});
    }
    return polygons;
}

} // namespace

Outlines find_outlines(std::span<const DVec2> points, std::span<const OutlineEdge> edges) {
    Outlines found;
    std::vector<Traced> loops = Tracer(points, edges).run(found.open_edges);
    for (Traced& t : loops)
        measure(points, t);
    found.polygons = nest(points, std::move(loops));
    return found;
}

} // namespace scanout::geom
