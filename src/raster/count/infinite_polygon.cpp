#include "raster/count/infinite_polygon.h"

#include "base/check.h"

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>

namespace scanout::raster {
namespace {

struct Polygon {
    std::array<ClipVertex, 24> vertex;
    std::size_t count = 0;
};

// Signed distance, >= 0 inside: near, then left, right, top, bottom of the guard band. It is
// inside of near where depth <= 1, that is where z <= w, be it a point or a direction. A parallel
// view has no near plane.
double distance(int plane, const ClipVertex& v, const ScreenTransform& t) {
    switch (plane) {
    case 0:
        return t.perspective ? v.w - v.z : v.w;
    case 1:
        return v.x - t.box.left * v.w;
    case 2:
        return t.box.right * v.w - v.x;
    case 3:
        return v.y - t.box.top * v.w;
    default:
        return t.box.bottom * v.w - v.y;
    }
}

// Cuts from the inside vertex to the outside one: polygons that share an edge get the same cut
// point.
ClipVertex intersect(int plane, const ScreenTransform& transform, const ClipVertex& in, double d_in,
                     const ClipVertex& out, double d_out) {
    const double t = d_in / (d_in - d_out);
    ClipVertex v{in.x + t * (out.x - in.x), in.y + t * (out.y - in.y), in.z + t * (out.z - in.z),
                 in.w + t * (out.w - in.w)};
    // Puts the vertex exactly on the plane, and in front of the eye: the divide needs w > 0.
    if (transform.perspective) v.w = plane == 0 ? v.z : std::max(v.w, v.z);
    v.w = std::max(v.w, 0x1p-900);
    if (plane == 1 || plane == 2)
        v.x = (plane == 1 ? transform.box.left : transform.box.right) * v.w;
    if (plane == 3 || plane == 4)
        v.y = (plane == 3 ? transform.box.top : transform.box.bottom) * v.w;
    return v;
}

void clip_plane(Polygon& polygon, int plane, const ScreenTransform& transform) {
    Polygon out;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const ClipVertex& a = polygon.vertex[i];
        const ClipVertex& b = polygon.vertex[i + 1 < polygon.count ? i + 1 : 0];
        const double da = distance(plane, a, transform), db = distance(plane, b, transform);
        const bool a_inside = da >= 0, b_inside = db >= 0;
        if (a_inside) out.vertex[out.count++] = a;
        if (a_inside != b_inside)
            out.vertex[out.count++] = a_inside ? intersect(plane, transform, a, da, b, db)
                                               : intersect(plane, transform, b, db, a, da);
        // Rounding may cut a polygon at more edges than a convex polygon can be cut at.
        if (out.count + 2 > out.vertex.size()) break;
    }
    polygon = out;
}

} // namespace

ClipVertex to_clip(const ScreenTransform& t, const DVec4& view) {
    const DVec4 v(view.x * t.unit, view.y * t.unit, view.z * t.unit, view.w);
    const double w = t.perspective ? -v.z : v.w;
    return {v.x * t.scale_x + w * t.centre_x, w * t.centre_y - v.y * t.scale_y,
            t.perspective ? t.box.near_w * v.w : (v.z - v.w * t.depth_origin) * t.depth_scale, w};
}

void add_polygon(std::span<const ClipVertex> vertices, const ScreenTransform& transform,
                 float weight, StencilSign side, std::uint32_t id,
                 std::vector<StencilTriangle>& out) {
    Polygon polygon;
    CHECK_LE(vertices.size(), 8U);
    for (const ClipVertex& vertex : vertices)
        polygon.vertex[polygon.count++] = vertex;
    for (int plane = 0; plane < 5 && polygon.count >= 3; ++plane)
        clip_plane(polygon, plane, transform);
    if (polygon.count < 3) return;
    std::array<ScreenVertex, 24> vertex;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const ClipVertex& v = polygon.vertex[i];
        if (!(v.w > 0)) return; // a polygon that only touches the eye's plane is not visible
        vertex[i] = transform.to_screen(v);
    }
    // The fan's hub is the first corner in canonical order, as for every clipped triangle.
    const auto before = [](const ScreenVertex& a, const ScreenVertex& b) {
        return std::tie(a.y, a.x, a.depth) < std::tie(b.y, b.x, b.depth);
    };
    const auto end = vertex.begin() + static_cast<std::ptrdiff_t>(polygon.count);
    std::rotate(vertex.begin(), std::min_element(vertex.begin(), end, before), end);
    for (std::size_t i = 2; i < polygon.count; ++i) {
        const std::optional<SetUp> clipped = set_up({vertex[0], vertex[i - 1], vertex[i]}, id);
        if (!clipped) continue;
        const bool negative = side == StencilSign::facing && !clipped->clockwise;
        out.push_back({clipped->triangle, negative ? -weight : weight});
    }
}

} // namespace scanout::raster
