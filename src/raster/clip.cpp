#include "raster/clip.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace scanout::raster {
namespace {

constexpr int kNear = 0, kPlanes = 5; // then left, right, top, bottom of the guard band

// Signed distance, >= 0 inside.
double distance(int plane, const ClipVertex& v, const ClipBox& box) {
    switch (plane) {
    case 0:
        return v.w - box.near_w;
    case 1:
        return v.x - box.left * v.w;
    case 2:
        return box.right * v.w - v.x;
    case 3:
        return v.y - box.top * v.w;
    default:
        return box.bottom * v.w - v.y;
    }
}

// d_in >= 0 > d_out, so the denominator is positive, rounding included (TOPICS T7).
ClipVertex intersect(int plane, const ClipBox& box, const ClipVertex& in, double d_in,
                     const ClipVertex& out, double d_out) {
    const double t = d_in / (d_in - d_out);
    ClipVertex v{in.x + t * (out.x - in.x), in.y + t * (out.y - in.y), in.z + t * (out.z - in.z),
                 in.w + t * (out.w - in.w)};
    // On the plane exactly and never behind near, although the sum cancels where the inside vertex
    // is many powers of ten further away: the divide that follows must not meet w <= 0.
    v.w = plane == 0 ? box.near_w : std::max(v.w, box.near_w);
    if (plane == 1 || plane == 2) v.x = (plane == 1 ? box.left : box.right) * v.w;
    if (plane == 3 || plane == 4) v.y = (plane == 3 ? box.top : box.bottom) * v.w;
    return v;
}

DVec3 cross_rows(const ClipVertex& a, const ClipVertex& b) {
    return {a.y * b.w - a.w * b.y, a.w * b.x - a.x * b.w, a.x * b.y - a.y * b.x};
}

} // namespace

HomogeneousTriangle homogeneous_triangle(const std::array<ClipVertex, 3>& vertex) {
    HomogeneousTriangle t{{{0, 1, 2}, false}, false, {}};
    auto& order = t.order.vertex;
    const auto before = [&](std::uint8_t i, std::uint8_t j) {
        const ClipVertex &a = vertex[i], &b = vertex[j];
        return std::tie(a.y, a.x, a.w) < std::tie(b.y, b.x, b.w);
    };
    for (const std::size_t i : {0, 1, 0}) {
        if (!before(order[i + 1], order[i])) continue;
        std::swap(order[i], order[i + 1]);
        t.order.odd = !t.order.odd;
    }
    const ClipVertex &a = vertex[order[0]], &b = vertex[order[1]], &c = vertex[order[2]];
    t.row = {cross_rows(b, c), cross_rows(c, a), cross_rows(a, b)};
    // The determinant has the sign of the visible part's area.
    const double det = dot3(t.row[0], DVec3(a.x, a.y, a.w));
    t.clockwise = det > 0;
    if (det < 0)
        for (DVec3& row : t.row)
            row = -row;
    return t;
}

NearPolygon cut_near(const std::array<ClipVertex, 3>& triangle, double near_w) {
    const ClipBox box{.near_w = near_w};
    NearPolygon out;
    const auto put = [&](const ClipVertex& v, int corner) {
        out.vertex[static_cast<std::size_t>(out.count)] = v;
        out.corner[static_cast<std::size_t>(out.count++)] = corner;
    };
    for (std::size_t i = 0; i < 3; ++i) {
        const ClipVertex &a = triangle[i], &b = triangle[(i + 1) % 3];
        const double da = distance(kNear, a, box), db = distance(kNear, b, box);
        const bool a_inside = da >= 0, b_inside = db >= 0;
        if (a_inside) put(a, static_cast<int>(i));
        if (a_inside != b_inside)
            put(a_inside ? intersect(kNear, box, a, da, b, db)
                         : intersect(kNear, box, b, db, a, da),
                -1);
    }
    return out;
}

bool clip(ClipVertex& a, ClipVertex& b, const ClipBox& box) {
    for (int plane = 0; plane < kPlanes; ++plane) {
        const double da = distance(plane, a, box), db = distance(plane, b, box);
        if (da < 0 && db < 0) return false;
        if (da < 0) a = intersect(plane, box, b, db, a, da);
        if (db < 0) b = intersect(plane, box, a, da, b, db);
    }
    return true;
}

} // namespace scanout::raster
