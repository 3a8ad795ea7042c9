// Clipping that must fail where ours holds: intersections taken in the order in which the polygon
// runs, so that neighbours cut their common edge from opposite ends (HARD-CASES 9); and cuts along
// the guard band that are snapped to the grid.
#include "raster/exactly_once.h"
#include "raster/off_screen_mesh.h"
#include "raster/screen/clip.h"

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
        const ClipVertex a{xa, ya, kNear, wa}, b{xb, yb, kNear, wb};
        const ClipVertex c{random.in(-9, 9), random.in(-9, 9), kNear, 1};
        const NearPolygon p = cut_near({a, b, c}, kNear), q = cut_near({b, a, c}, kNear);
        // The cut of the edge a-b stands next to a.
        const auto cut = [&](const NearPolygon& polygon, int step) {
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

// Sutherland and Hodgman 1974, round the near plane and a box of the screen, always from the inside
// vertex to the outside one; what is left is snapped and cut into a fan.
using Polygon = std::vector<ClipVertex>;
Polygon cut_by(const Polygon& in, double x, double y, double w, double constant) {
    const auto distance = [&](const ClipVertex& v) {
        return x * v.x + y * v.y + w * v.w + constant;
    };
    Polygon out;
    for (std::size_t i = 0; i < in.size(); ++i) {
        const ClipVertex &a = in[i], &b = in[(i + 1) % in.size()];
        const double da = distance(a), db = distance(b);
        if (da >= 0) out.push_back(a);
        if ((da >= 0) == (db >= 0)) continue;
        const ClipVertex &from = da >= 0 ? a : b, &to = da >= 0 ? b : a;
        const double t = (da >= 0 ? da : db) / std::abs(da - db);
        out.push_back({from.x + t * (to.x - from.x), from.y + t * (to.y - from.y),
                       from.z + t * (to.z - from.z), from.w + t * (to.w - from.w)});
    }
    return out;
}
void draw_snapped_cuts(VisibilityTile& tile, Polygon polygon, const ClipBox& box) {
    polygon = cut_by(polygon, 0, 0, 1, -box.near_w);
    polygon = cut_by(polygon, 1, 0, -box.left, 0);
    polygon = cut_by(polygon, -1, 0, box.right, 0);
    polygon = cut_by(polygon, 0, 1, -box.top, 0);
    polygon = cut_by(polygon, 0, -1, box.bottom, 0);
    raster::test::Corners fan{};
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto snapped = [&](double v) {
            return static_cast<std::int32_t>(std::nearbyint(v / polygon[i].w * 256));
        };
        fan[2] = {snapped(polygon[i].x), snapped(polygon[i].y)};
        if (i == 0) fan[0] = fan[2];
        if (i >= 2 && raster::test::has_area(fan)) tile.draw(raster::test::set_up(fan, 0));
        fan[1] = fan[2];
    }
}

// HARD-CASES P7: a sliver whose ends are cut one step of the grid apart, or at the same point,
// turns over when they are snapped, and lies on its neighbours.
TEST(NaiveClip, SnappedCutsTurnSliversOverAndOursAreNotSnapped) {
    using raster::test::OffScreenMesh;
    constexpr int kSide = OffScreenMesh::kSide;
    constexpr double kGuard = 1;
    ScreenTransform transform(OffScreenMesh::view(), kSide, kSide);
    transform.set_guard(kGuard);
    Random random(4);
    raster::test::Hits snapped, ours;
    for (int i = 0; i < 4000; ++i) {
        const auto mesh = raster::test::sliver(random, kGuard);
        if (!mesh) continue;
        std::vector<int> hits[2];
        for (auto& h : hits)
            h.resize(std::size_t{kSide} * kSide);
        for (std::size_t t = 0; t < mesh->triangle.size(); ++t) {
            std::array<ClipVertex, 3> v{};
            std::array<ScreenVertex, 3> on_screen{};
            for (std::size_t k = 0; k < 3; ++k) {
                v[k] = transform.to_clip(mesh->corners(t)[k]);
                on_screen[k] = transform.transform(mesh->corners(t)[k]);
            }
            VisibilityTile tile[2];
            for (VisibilityTile& to : tile)
                to.reset({0, 0, kSide, kSide}, 1);
            draw_snapped_cuts(tile[0], {v.begin(), v.end()}, transform.box);
            for (const ClippedTriangle& clipped :
                 clip_triangle(v, on_screen, transform.box.near_w, 0))
                tile[1].draw_clipped(clipped);
            for (std::size_t k = 0; k < 2; ++k)
                for (int y = 0; y < kSide; ++y)
                    for (int x = 0; x < kSide; ++x)
                        hits[k][static_cast<std::size_t>(y * kSide + x)] +=
                            tile[k].id(x, y) == 0 ? 1 : 0;
        }
        for (const auto& [from, to] : {std::pair(&hits[0], &snapped), {&hits[1], &ours}})
            for (const int n : *from)
                (n == 0 ? to->none : n == 1 ? to->once : to->more) += 1;
    }
    EXPECT_GT(snapped.faults(), 5);
    EXPECT_EQ(ours.faults(), 0);
    EXPECT_GT(ours.once, 5000000);
    record("snapped_cuts_doubles", static_cast<double>(snapped.more));
    record("snapped_cuts_gaps", static_cast<double>(snapped.none));
}

} // namespace
} // namespace scanout::naive
