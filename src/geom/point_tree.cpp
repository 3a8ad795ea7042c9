#include "geom/point_tree.h"

#include <algorithm>
#include <cmath>

namespace scanout::geom {
namespace {

double cross(const DVec2& a, const DVec2& b) {
    return a.x * b.y - a.y * b.x;
}

double dot(const DVec2& a, const DVec2& b) {
    return a.x * b.x + a.y * b.y;
}

double size_of(const DVec2& a) {
    return std::abs(a.x) + std::abs(a.y);
}

// The direction in which points vary most: the greater eigenvector of their covariance.
template <class PointOf>
DVec2 principal_axis(std::size_t count, const PointOf& point) {
    DVec2 mean(0);
    for (std::size_t i = 0; i < count; ++i)
        mean += point(i);
    mean /= static_cast<double>(count);
    double xx = 0, xy = 0, yy = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const DVec2 d = point(i) - mean;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
    }
    const double half = (xx - yy) / 2, root = std::sqrt(half * half + xy * xy);
    const DVec2 axis = half > 0 ? DVec2(half + root, xy) : DVec2(xy, root - half);
    const double length = std::sqrt(dot(axis, axis));
    return length > 0 && length < 1e300 ? axis / length : DVec2(1, 0);
}

// Far above the rounding of the sums below, relative to their terms.
constexpr double kSlack = 1e-14;

} // namespace

PointTree::PointTree(std::span<const DVec2> points, std::vector<std::uint32_t> members)
    : members_(std::move(members)) {
    constexpr std::size_t kInLeaf = 4;
    while (leaves_ * kInLeaf < members_.size())
        leaves_ *= 2;
    boxes_.resize(2 * leaves_ - 1);
    live_.resize(boxes_.size());
    if (!members_.empty()) build(points, 0, 0, leaves_);
}

// Along both axes of the box, from its centre.
PointTree::Bounds PointTree::bounds(std::span<const DVec2> points, const Box& axes,
                                    std::size_t begin, std::size_t end) const {
    Bounds b{DVec2(1e300), DVec2(-1e300)};
    for (std::size_t i = begin; i < end; ++i) {
        const DVec2 d = points[members_[i]] - axes.centre;
        const double along = dot(d, axes.along), across = cross(axes.along, d);
        b.lo = {std::min(b.lo.x, along), std::min(b.lo.y, across)};
        b.hi = {std::max(b.hi.x, along), std::max(b.hi.y, across)};
    }
    return b;
}

// Cuts the members of a node at their median along the longer axis of its box; along the shorter
// one where that leaves boxes of less than half the area. This parts two lines of points that run
// side by side, which a sliver may lie between.
void PointTree::build(std::span<const DVec2> points, std::uint32_t node, std::size_t first,
                      std::size_t leaves) {
    const std::size_t begin = first_of(first), end = first_of(first + leaves);
    const auto point = [&](std::size_t i) { return points[members_[begin + i]]; };
    Box& box = boxes_[node];
    box = {point(0), principal_axis(end - begin, point), {}};
    const Bounds all = bounds(points, box, begin, end);
    live_[node] = static_cast<std::uint32_t>(end - begin);
    if (leaves > 1) {
        const std::size_t middle = first_of(first + leaves / 2);
        const auto cut = [&](const DVec2& axis) {
            const auto at = [&](std::size_t i) {
                return members_.begin() + static_cast<std::ptrdiff_t>(i);
            };
            std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t i, std::uint32_t k) {
                return dot(points[i], axis) < dot(points[k], axis);
            });
            double area = 0;
            for (const Bounds& part :
                 {bounds(points, box, begin, middle), bounds(points, box, middle, end)})
                area += (part.hi.x - part.lo.x) * (part.hi.y - part.lo.y);
            return area;
        };
        const DVec2 across(-box.along.y, box.along.x);
        const double by_shorter = cut(across), by_longer = cut(box.along);
        if (by_shorter < by_longer / 2) cut(across);
        build(points, 2 * node + 1, first, leaves / 2);
        build(points, 2 * node + 2, first + leaves / 2, leaves / 2);
    }
    const DVec2 middle = (all.lo + all.hi) * 0.5;
    box.centre += box.along * middle.x + DVec2(-box.along.y, box.along.x) * middle.y;
    box.half = (all.hi - all.lo) * 0.5 + kSlack * (size_of(box.centre) + size_of(all.hi - all.lo));
}

// False where an axis of the box or a side of the triangle parts them.
bool PointTree::may_meet(const Box& box, const Triangle& triangle) {
    DVec2 lo(1e300), hi(-1e300);
    for (int i = 0; i < 3; ++i) {
        const DVec2 r = triangle.corners[i] - box.centre;
        const DVec2& edge = triangle.edges[i];
        // The box's leftmost point, seen along the edge.
        const double reach = box.half.x * std::abs(cross(edge, box.along)) +
                             box.half.y * std::abs(dot(edge, box.along));
        if (cross(r, edge) + reach < -kSlack * size_of(r) * size_of(edge)) return false;
        const DVec2 at(dot(r, box.along), cross(box.along, r));
        const double slack = kSlack * size_of(r);
        lo = {std::min(lo.x, at.x - slack), std::min(lo.y, at.y - slack)};
        hi = {std::max(hi.x, at.x + slack), std::max(hi.y, at.y + slack)};
    }
    return lo.x <= box.half.x && hi.x >= -box.half.x && lo.y <= box.half.y && hi.y >= -box.half.y;
}

} // namespace scanout::geom
