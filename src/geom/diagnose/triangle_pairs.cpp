#include "geom/diagnose/triangle_pairs.h"

#include "math/predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scanout::geom {
namespace {

double length_of(const DVec3& v) {
    return std::sqrt(dot3(v, v));
}

bool edge_crosses(const DVec3& p, const DVec3& q, const Corners& t) {
    const int side_p = orient3d(t[0], t[1], t[2], p);
    if (side_p == 0 || orient3d(t[0], t[1], t[2], q) != -side_p) return false;
    const int s0 = orient3d(p, q, t[0], t[1]);
    const int s1 = orient3d(p, q, t[1], t[2]);
    if (s0 * s1 < 0) return false;
    const int s2 = orient3d(p, q, t[2], t[0]);
    return s1 * s2 >= 0 && s2 * s0 >= 0;
}

// Corners on both sides of the other's plane, farther from it than `touch`.
bool straddles(const Corners& a, const Corners& plane, double touch) {
    const DVec3 normal = cross3(plane[1] - plane[0], plane[2] - plane[0]);
    const double least = touch * length_of(normal);
    bool above = false, below = false;
    for (const DVec3& p : a) {
        const double height = dot3(p - plane[0], normal);
        above |= height > least;
        below |= height < -least;
    }
    return above && below;
}

double longest_edge(const Corners& t) {
    return std::max({length_of(t[1] - t[0]), length_of(t[2] - t[1]), length_of(t[0] - t[2])});
}

// How deep b's projection reaches into a's across a's edges, the least of all; negative where an
// edge separates them. `normal`: unit, of a's plane.
double depth_across(const Corners& a, const DVec3& normal, const Corners& b) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
        const DVec3 edge = a[static_cast<std::size_t>(i + 1) % 3] - a[static_cast<std::size_t>(i)];
        const DVec3 inwards = cross3(normal, edge) / length_of(edge);
        double deepest = -std::numeric_limits<double>::infinity();
        for (const DVec3& p : b)
            deepest = std::max(deepest, dot3(p - a[static_cast<std::size_t>(i)], inwards));
        least = std::min(least, deepest);
    }
    return least;
}

struct Height {
    double nearest, farthest; // of another triangle's corners from the plane, absolute
};
Height heights(const Corners& plane, const DVec3& normal, const Corners& t) {
    Height h{std::numeric_limits<double>::infinity(), 0};
    for (const DVec3& p : t) {
        const double height = std::abs(dot3(p - plane[0], normal));
        h = {std::min(h.nearest, height), std::max(h.farthest, height)};
    }
    return h;
}

} // namespace

bool triangles_cross(const Corners& a, const Corners& b, double touch) {
    if (!straddles(a, b, touch) || !straddles(b, a, touch)) return false;
    for (std::size_t i = 0; i < 3; ++i)
        if (edge_crosses(a[i], a[(i + 1) % 3], b) || edge_crosses(b[i], b[(i + 1) % 3], a))
            return true;
    return false;
}

std::optional<double> overlap_gap(const Corners& a, const Corners& b, double gap) {
    DVec3 normal_a = cross3(a[1] - a[0], a[2] - a[0]), normal_b = cross3(b[1] - b[0], b[2] - b[0]);
    const double area_a = length_of(normal_a), area_b = length_of(normal_b);
    if (area_a == 0 || area_b == 0) return std::nullopt;
    normal_a = normal_a / area_a;
    normal_b = normal_b / area_b;
    const Height b_over_a = heights(a, normal_a, b), a_over_b = heights(b, normal_b, a);
    if (std::min(b_over_a.farthest, a_over_b.farthest) > gap) return std::nullopt;
    constexpr double kParallel = 1e-3; // of small triangles with a height within `gap`
    if (length_of(cross3(normal_a, normal_b)) > kParallel) return std::nullopt;
    const double least = kOverlap * std::min(longest_edge(a), longest_edge(b));
    if (depth_across(a, normal_a, b) <= least || depth_across(b, normal_b, a) <= least)
        return std::nullopt;
    return std::min(b_over_a.nearest, a_over_b.nearest);
}

} // namespace scanout::geom
