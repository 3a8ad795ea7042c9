// Polygons with holes into triangles: each hole is joined to the outline by a bridge, an edge that
// is gone along both ways, which leaves one closed outline. Eberly 2008.
#include "geom/outlines.h"
#include "geom/triangulate.h"
#include "math/predicates.h"

#include <algorithm>
#include <utility>

namespace scanout::geom {
namespace {

using Ring = std::vector<std::uint32_t>;

class Bridges {
public:
    explicit Bridges(std::span<const DVec2> points) : points_(points) {}

    // Holes from the right to the left: nothing but the outline, and holes that are joined to it,
    // lies to the right of one.
    Ring join(const Polygon& polygon) {
        ring_ = polygon.outline.points;
        std::vector<Ring> holes;
        for (const Loop& hole : polygon.holes)
            holes.push_back(from_rightmost(hole.points));
        std::stable_sort(holes.begin(), holes.end(), [&](const Ring& a, const Ring& b) {
            return right_of(a.front(), b.front());
        });
        for (const Ring& hole : holes)
            add(hole);
        return std::move(ring_);
    }

private:
    bool right_of(std::uint32_t a, std::uint32_t b) const {
        const DVec2 &p = points_[a], &q = points_[b];
        return p.x != q.x ? p.x > q.x : p.y > q.y;
    }
    Ring from_rightmost(Ring ring) const {
        const auto first =
            std::min_element(ring.begin(), ring.end(),
                             [&](std::uint32_t a, std::uint32_t b) { return right_of(a, b); });
        std::rotate(ring.begin(), first, ring.end());
        return ring;
    }

    // The nearest corner that the hole's rightmost point sees, of those to its right; where
    // outlines cross, none may be, and the nearest is taken.
    void add(const Ring& hole) {
        const DVec2& from = points_[hole.front()];
        std::vector<std::pair<double, std::size_t>> corners;
        for (std::size_t i = 0; i < ring_.size(); ++i) {
            const DVec2 d = points_[ring_[i]] - from;
            if (d.x >= 0) corners.emplace_back(d.x * d.x + d.y * d.y, i);
        }
        std::sort(corners.begin(), corners.end());
        const auto seen = std::find_if(corners.begin(), corners.end(), [&](const auto& corner) {
            return leads_inside(corner.second, hole) && is_free(ring_[corner.second], hole.front());
        });
        const std::size_t at = seen != corners.end() ? seen->second
                               : !corners.empty()    ? corners.front().second
                                                     : 0;
        Ring bridge = {ring_[at]};
        bridge.insert(bridge.end(), hole.begin(), hole.end());
        bridge.push_back(hole.front());
        ring_.insert(ring_.begin() + static_cast<std::ptrdiff_t>(at), bridge.begin(), bridge.end());
    }

    // Does the way from a corner of the ring to the hole begin within the ring's inside? A point
    // that bridges meet has several corners, each with its own part of what surrounds it.
    bool leads_inside(std::size_t corner, const Ring& hole) const {
        const std::size_t n = ring_.size();
        const DVec2& before = points_[ring_[(corner + n - 1) % n]];
        const DVec2& p = points_[ring_[corner]];
        const DVec2& after = points_[ring_[(corner + 1) % n]];
        const DVec2& to = points_[p == points_[hole.front()] ? hole[1] : hole.front()];
        const bool left_of_before = orient2d(before, p, to) > 0;
        const bool left_of_after = orient2d(p, after, to) > 0;
        const bool convex = orient2d(before, p, after) > 0;
        return convex ? left_of_before && left_of_after : left_of_before || left_of_after;
    }

    // Does no edge of the ring cross or touch the bridge between two points, but at its ends?
    bool is_free(std::uint32_t a, std::uint32_t b) const {
        const DVec2 &p = points_[a], &q = points_[b];
        const double low_x = std::min(p.x, q.x), high_x = std::max(p.x, q.x);
        const double low_y = std::min(p.y, q.y), high_y = std::max(p.y, q.y);
        const std::size_t n = ring_.size();
        for (std::size_t i = 0; i < n; ++i) {
            const std::uint32_t from = ring_[i], to = ring_[i + 1 < n ? i + 1 : 0];
            const DVec2 &u = points_[from], &v = points_[to];
            if (std::max(u.x, v.x) < low_x || std::min(u.x, v.x) > high_x ||
                std::max(u.y, v.y) < low_y || std::min(u.y, v.y) > high_y)
                continue;
            const int of_u = orient2d(p, q, u), of_v = orient2d(p, q, v);
            if (from == a || to == a) {
                // It begins where the bridge does: only one that lies along the bridge is in its
                // way, and then its other end is a nearer corner.
                const bool along = of_u == 0 && of_v == 0;
                const DVec2& end = from == a ? v : u;
                if (along && dot(end - p, q - p) > 0) return false;
                continue;
            }
            const int of_p = orient2d(u, v, p), of_q = orient2d(u, v, q);
            if (of_u * of_v <= 0 && of_p * of_q <= 0) return false;
        }
        return true;
    }
    static double dot(const DVec2& a, const DVec2& b) { return a.x * b.x + a.y * b.y; }

    std::span<const DVec2> points_;
    Ring ring_;
};

} // namespace

void triangulate(std::span<const DVec2> points, const Polygon& polygon,
                 std::vector<std::uint32_t>& out) {
    const Ring ring = Bridges(points).join(polygon);
    std::vector<DVec3> corners;
    corners.reserve(ring.size());
    for (const std::uint32_t p : ring)
        corners.emplace_back(points[p].x, points[p].y, 0);
    std::vector<std::uint32_t> triangles;
    triangulate(corners, triangles);
    for (std::size_t i = 0; i < triangles.size(); i += 3) {
        const std::uint32_t a = ring[triangles[i]], b = ring[triangles[i + 1]],
                            c = ring[triangles[i + 2]];
        if (a != b && b != c && c != a) out.insert(out.end(), {a, b, c});
    }
}

} // namespace scanout::geom
