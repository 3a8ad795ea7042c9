#include "raster/clipped/clipped_triangle.h"

#include "raster/check_lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace scanout::raster {
namespace {

constexpr Int128 kUnit = Int128{1} << ExactPoint::kBits;

auto key(const ExactPoint& p) {
    return std::tie(p.y, p.x, p.w, p.z);
}
bool before(const ExactPoint& a, const ExactPoint& b) {
    return key(a) < key(b);
}

struct Line {
    Int128 a, b, c; // below 2^101
};
Line through(const ExactPoint& p, const ExactPoint& q) {
    return {Int128{p.y} * q.w - Int128{p.w} * q.y, Int128{p.w} * q.x - Int128{p.x} * q.w,
            Int128{p.x} * q.y - Int128{p.y} * q.x};
}

// high 2^64 + low: a determinant has up to 153 bits.
struct Wide {
    Int128 high;
    std::uint64_t low;
    int sign() const { return high < 0 ? -1 : (high > 0 || low > 0 ? 1 : 0); }
    double size() const {
        const bool negative = high < 0;
        const std::uint64_t bottom = negative ? ~low + 1 : low;
        const Int128 top = negative ? ~high + (bottom == 0 ? 1 : 0) : high;
        return static_cast<double>(top) * 0x1p64 + static_cast<double>(bottom);
    }
};
Wide determinant(const ExactPoint& p, const ExactPoint& q, const ExactPoint& r) {
    const Line l = through(q, r);
    Int128 high = 0, low = 0;
    for (const auto& [factor, value] : {std::pair(p.x, l.a), {p.y, l.b}, {p.w, l.c}}) {
        high += factor * (value >> 64);
        low += Int128{factor} * static_cast<std::uint64_t>(value);
    }
    return {high + (low >> 64), static_cast<std::uint64_t>(low)};
}

// Degenerate triangles, whose three vertices lie on one line, are not added.
void add(ClippedTriangles& clipped, std::array<ExactPoint, 3> v, std::uint32_t id) {
    bool odd = false;
    for (const std::size_t i : {0, 1, 0}) {
        if (!before(v[i + 1], v[i])) continue;
        std::swap(v[i], v[i + 1]);
        odd = !odd;
    }
    const int sign = determinant(v[0], v[1], v[2]).sign();
    if (sign == 0) return;
    clipped.triangle[static_cast<std::size_t>(clipped.count++)] = {v, id, sign < 0,
                                                                   (sign > 0) != odd};
}

// Rounds to a whole number. Saturates, and NaN becomes a number: finite ends may lie so far apart
// that the cut between them is not finite.
std::int64_t round_to_whole(double v) {
    constexpr double kMax = 0x1p50;
    v = v > -kMax ? v : -kMax;
    v = v < kMax ? v : kMax;
    return static_cast<std::int64_t>((v + 0x1.8p52) - 0x1.8p52);
}

} // namespace

ExactPoint point_on_screen(const ScreenVertex& v, const EdgePoint& edge_point) {
    return {v.x, v.y, static_cast<std::int64_t>(kUnit), v.depth, v.depth, edge_point};
}

ExactPoint point_off_screen(const ClipVertex& v, const EdgePoint& edge_point) {
    check_before_rounding(v);
    // The power of two that brings the largest of x, y, 2^15 w just below 2^50.
    const double most = std::max({std::abs(v.x) * 0x1p-16, std::abs(v.y) * 0x1p-16, v.w * 0x1p-1});
    const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(most) >> 52) - 1023;
    const int up = std::min(33 - exponent, 1000);
    const auto scale = std::bit_cast<double>(static_cast<std::uint64_t>(up + 1023) << 52);
    return {round_to_whole(v.x * scale),
            round_to_whole(v.y * scale),
            round_to_whole(v.w * scale * 0x1p15),
            v.z * scale * 0x1p-8,
            v.z / v.w,
            edge_point};
}

ClippedTriangles split_polygon(std::span<const ExactPoint> polygon, std::uint32_t id) {
    ClippedTriangles clipped;
    if (polygon.size() == 3) {
        add(clipped, {polygon[0], polygon[1], polygon[2]}, id);
    } else {
        const auto first = static_cast<std::size_t>(
            std::min_element(polygon.begin(), polygon.end(), before) - polygon.begin());
        const auto from = [&](std::size_t start) {
            const auto at = [&](std::size_t i) { return polygon[(first + start + i) % 4]; };
            ClippedTriangles two;
            add(two, {at(0), at(1), at(2)}, id);
            add(two, {at(0), at(2), at(3)}, id);
            return two;
        };
        const auto folded = [](const ClippedTriangles& two) {
            return two.count == 2 && two.triangle[0].clockwise != two.triangle[1].clockwise;
        };
        // Snapping may have bent the polygon inwards; then only one diagonal lies inside it.
        clipped = from(0);
        if (folded(clipped))
            if (const ClippedTriangles other = from(1); !folded(other)) clipped = other;
        auto& [one, two] = clipped.triangle;
        if (clipped.count == 2 &&
            std::lexicographical_compare(two.vertex.begin(), two.vertex.end(), one.vertex.begin(),
                                         one.vertex.end(), before))
            std::swap(one, two);
    }
    return clipped;
}

ClippedTriangles clip_triangle(const std::array<ClipVertex, 3>& vertex,
                               const std::array<ScreenVertex, 3>& on_screen, double near_w,
                               std::uint32_t id) {
    const NearPolygon polygon = cut_near(vertex, near_w);
    if (polygon.count < 3) return {};
    std::array<ExactPoint, 4> point;
    const auto count = static_cast<std::size_t>(polygon.count);
    for (std::size_t i = 0; i < count; ++i) {
        const EdgePoint& edge_point = polygon.edge_point[i];
        const ScreenVertex& snapped = on_screen[edge_point.from];
        point[i] = !edge_point.cut() && snapped.on_screen()
                       ? point_on_screen(snapped, edge_point)
                       : point_off_screen(polygon.vertex[i], edge_point);
    }
    return split_polygon(std::span(point).first(count), id);
}

ExactEdges edges_of(const ClippedTriangle& clipped) {
    ExactEdges e;
    for (std::size_t i = 0; i < 3; ++i) {
        const ExactPoint &from = clipped.vertex[(i + 1) % 3], &to = clipped.vertex[(i + 2) % 3];
        const Line l = clipped.flipped ? through(to, from) : through(from, to);
        const bool top_left = l.a > 0 || (l.a == 0 && l.b > 0);
        e.a[i] = l.a;
        e.b[i] = l.b;
        e.c[i] = l.c * kUnit - (top_left ? 0 : 1);
    }
    return e;
}

bool covers(const ClippedTriangle& clipped, std::int32_t x, std::int32_t y) {
    const ExactEdges e = edges_of(clipped);
    return e.at(0, x, y) >= 0 && e.at(1, x, y) >= 0 && e.at(2, x, y) >= 0;
}

// A vertex whose coordinates before the divide are (X, Y, W) 2^e, with an exponent e of its own,
// weighs its edge function times 2^e. e is read from z in perspective, where depth times w is the
// near plane's distance at every vertex; else from w, which is 1 at every vertex.
ClippedWeights weights_of(const ClippedTriangle& clipped, bool perspective) {
    const ExactEdges edges = edges_of(clipped);
    double scale[3], largest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const ExactPoint& p = clipped.vertex[i];
        scale[i] = perspective ? p.z : static_cast<double>(p.w);
        largest = std::max(largest, scale[i]);
    }
    ClippedWeights weights;
    for (std::size_t i = 0; i < 3; ++i) {
        const double factor = scale[i] / largest;
        weights.a[i] = static_cast<double>(edges.a[i]) * factor;
        weights.b[i] = static_cast<double>(edges.b[i]) * factor;
        weights.c[i] = static_cast<double>(edges.c[i]) * factor;
    }
    return weights;
}

std::size_t opposite_common_edge(const ClippedTriangles& two) {
    const auto& other = two.triangle[1].vertex;
    const auto shared = [&](const ExactPoint& p) {
        return std::any_of(other.begin(), other.end(),
                           [&](const ExactPoint& q) { return key(p) == key(q); });
    };
    const auto& first = two.triangle[0].vertex;
    for (std::size_t i = 0; i < 2; ++i)
        if (!shared(first[i])) return i;
    return 2;
}

double size_of(const ClippedTriangle& clipped) {
    return determinant(clipped.vertex[0], clipped.vertex[1], clipped.vertex[2]).size();
}

image::Rect pixel_bounds(const ClippedTriangle& clipped, int width, int height,
                         const SampleExtent& extent) {
    // Beyond any picture. Two more steps on either side cover the rounding of the division and the
    // conversion.
    constexpr double kFar = 0x1p28;
    double low[2] = {kFar, kFar}, high[2] = {-kFar, -kFar};
    for (const ExactPoint& p : clipped.vertex) {
        const std::int64_t at[2] = {p.x, p.y};
        for (int axis = 0; axis < 2; ++axis) {
            const bool infinite = p.w == 0;
            const double v = infinite ? 0
                                      : static_cast<double>(at[axis]) / static_cast<double>(p.w) *
                                            static_cast<double>(kUnit);
            low[axis] = std::min(low[axis], infinite ? -kFar : v - 2);
            high[axis] = std::max(high[axis], infinite ? kFar : v + 2);
        }
    }
    const auto units = [&](double v) {
        return static_cast<std::int32_t>(std::clamp(v, -kFar, kFar));
    };
    const auto first = [&](double v, std::int32_t last_sample) {
        return (units(v) - last_sample + kSubpixel - 1) >> kSubpixelBits;
    };
    const auto end = [&](double v, std::int32_t first_sample) {
        return ((units(v) - first_sample) >> kSubpixelBits) + 1;
    };
    return {std::max(first(low[0], extent.high.x), 0), std::max(first(low[1], extent.high.y), 0),
            std::min(end(high[0], extent.low.x), width),
            std::min(end(high[1], extent.low.y), height)};
}

} // namespace scanout::raster
