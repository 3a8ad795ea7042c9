#include "raster/screen/clip.h"

#include <algorithm>

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

// Share of the way from the inside to the outside. d_in >= 0 > d_out, so the denominator is
// positive, rounding included (HARD-CASES T7).
double fraction(double d_in, double d_out) {
    return d_in / (d_in - d_out);
}

ClipVertex intersect(int plane, const ClipBox& box, const ClipVertex& in, double d_in,
                     const ClipVertex& out, double d_out) {
    // A weighted mean: no term is larger than the coordinate in it, however far one vertex lies
    // beyond the other. in + t (out - in) would cancel to noise at ratios above 2^53.
    const double of_in = -d_out / (d_in - d_out), of_out = fraction(d_in, d_out);
    ClipVertex v{in.x * of_in + out.x * of_out, in.y * of_in + out.y * of_out,
                 in.z * of_in + out.z * of_out, in.w * of_in + out.w * of_out};
    v.w = plane == 0 ? box.near_w : std::max(v.w, box.near_w);
    if (plane == 1 || plane == 2) v.x = (plane == 1 ? box.left : box.right) * v.w;
    if (plane == 3 || plane == 4) v.y = (plane == 3 ? box.top : box.bottom) * v.w;
    return v;
}

} // namespace

NearPolygon cut_near(const std::array<ClipVertex, 3>& triangle, double near_w) {
    const ClipBox box{.near_w = near_w};
    NearPolygon out;
    const auto append = [&](const ClipVertex& v, const EdgePoint& edge_point) {
        out.vertex[static_cast<std::size_t>(out.count)] = v;
        out.edge_point[static_cast<std::size_t>(out.count++)] = edge_point;
    };
    for (std::uint8_t i = 0; i < 3; ++i) {
        const auto next = static_cast<std::uint8_t>((i + 1) % 3);
        const double di = distance(kNear, triangle[i], box);
        const double dn = distance(kNear, triangle[next], box);
        const bool inside = di >= 0;
        if (inside) append(triangle[i], {i, i, 0});
        if (inside == (dn >= 0)) continue;
        const std::uint8_t in = inside ? i : next, beyond = inside ? next : i;
        const double d_in = inside ? di : dn, d_out = inside ? dn : di;
        append(intersect(kNear, box, triangle[in], d_in, triangle[beyond], d_out),
               {in, beyond, fraction(d_in, d_out)});
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
