// Clipping that must fail where ours holds: intersections taken in the order in which the polygon
// runs, so that neighbours cut their common edge from opposite ends (HARD-CASES row 9, finding 6).
#include "raster/clip.h"
#include "raster/exact.h"

#include <bit>
#include <cmath>

namespace scanout::naive {
namespace {

using namespace raster;
using raster::test::record;
using scanout::test::Random;

template <class Real>
struct Vertex {
    Real x, y, w;
};

template <class Real>
Vertex<Real> mix(const Vertex<Real>& a, const Vertex<Real>& b, Real near_w) {
    const Real t = (a.w - near_w) / (a.w - b.w);
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), near_w};
}

struct Apart {
    int edges = 0, differ = 0;
    double worst_px = 0;
    double percent() const { return 100.0 * differ / edges; }
};

// a inside, b behind near: what one triangle gets for the edge a-b and its neighbour for b-a.
template <class Real>
void cut_both_ways(Apart& apart, const Vertex<Real>& a, const Vertex<Real>& b, Real near_w) {
    const Vertex<Real> one = mix(a, b, near_w), other = mix(b, a, near_w);
    ++apart.edges;
    apart.differ += one.x != other.x || one.y != other.y ? 1 : 0;
    for (const Real d : {one.x - other.x, one.y - other.y})
        apart.worst_px = std::max(apart.worst_px, std::abs(static_cast<double>(d) / near_w));
}

TEST(NaiveClip, InPolygonOrderASharedEdgeIsCutAtTwoPointsAndOursIsNot) {
    constexpr double kNear = 0x1p-10;
    Random random(1);
    Apart in_float, in_double, ours;
    for (int i = 0; i < 300000; ++i) {
        const double wa = kNear + std::exp2(random.in(-9, 6)), wb = -std::exp2(random.in(-9, 6));
        const double xa = random.in(-500, 500) * wa, ya = random.in(-500, 500) * wa,
                     xb = random.in(-500, 500) * -wb, yb = random.in(-500, 500) * -wb;
        const auto f = [](double d) { return static_cast<float>(d); };
        cut_both_ways<float>(in_float, {f(xa), f(ya), f(wa)}, {f(xb), f(yb), f(wb)}, f(kNear));
        cut_both_ways<double>(in_double, {xa, ya, wa}, {xb, yb, wb}, kNear);
        // Ours, as two triangles with the edge in opposite directions.
        ClipPolygon p, q;
        const ClipVertex a{xa, ya, kNear, wa}, b{xb, yb, kNear, wb};
        const ClipVertex c{random.in(-9, 9), random.in(-9, 9), kNear, 1};
        p.count = q.count = 3;
        p.vertex = {a, b, c};
        q.vertex = {b, a, c};
        clip(p, {.near_w = kNear});
        clip(q, {.near_w = kNear});
        // The cut of the edge a-b stands next to a.
        const auto cut = [&](const ClipPolygon& polygon, int step) {
            for (int k = 0; k < polygon.count; ++k) {
                const ClipVertex& v = polygon.vertex[static_cast<std::size_t>(k)];
                if (v.x == a.x && v.y == a.y && v.w == a.w)
                    return polygon.vertex[static_cast<std::size_t>((k + step + polygon.count) %
                                                                   polygon.count)];
            }
            return ClipVertex{};
        };
        const ClipVertex one = cut(p, 1), other = cut(q, -1);
        ++ours.edges;
        ours.differ += one.x == other.x && one.y == other.y && one.w == other.w ? 0 : 1;
    }
    EXPECT_EQ(ours.differ, 0);
    EXPECT_GT(in_double.percent(), 50);
    EXPECT_GT(in_float.percent(), 50);
    EXPECT_GT(in_float.worst_px, 1.0 / 256); // another snapped vertex: a crack
    record("polygon_order_in_float_differs_percent", in_float.percent());
    record("polygon_order_in_float_worst_px", in_float.worst_px);
    record("polygon_order_in_double_differs_percent", in_double.percent());
    record("polygon_order_in_double_worst_px", in_double.worst_px);
    record("ours_differ", ours.differ);
}

} // namespace
} // namespace scanout::naive
