#include "raster/clip.h"

namespace scanout::raster {
namespace {

constexpr int kPlanes = 5; // near first, then left, right, top, bottom of the guard band

// Signed distance, >= 0 inside.
double distance(int plane, const ClipVertex& v, double near_w) {
    switch (plane) {
    case 0:
        return v.w - near_w;
    case 1:
        return v.x + kGuardPixels * v.w;
    case 2:
        return kGuardPixels * v.w - v.x;
    case 3:
        return v.y + kGuardPixels * v.w;
    default:
        return kGuardPixels * v.w - v.y;
    }
}

// d_in >= 0 > d_out, so the denominator is positive, rounding included (TOPICS T7).
ClipVertex intersect(const ClipVertex& in, double d_in, const ClipVertex& out, double d_out) {
    const double t = d_in / (d_in - d_out);
    return {in.x + t * (out.x - in.x), in.y + t * (out.y - in.y), in.z + t * (out.z - in.z),
            in.w + t * (out.w - in.w)};
}

void clip_plane(ClipPolygon& polygon, int plane, double near_w) {
    ClipPolygon out;
    for (int i = 0; i < polygon.count; ++i) {
        const ClipVertex& a = polygon.vertex[static_cast<std::size_t>(i)];
        const ClipVertex& b = polygon.vertex[static_cast<std::size_t>((i + 1) % polygon.count)];
        const double da = distance(plane, a, near_w), db = distance(plane, b, near_w);
        const bool a_inside = da >= 0, b_inside = db >= 0;
        if (a_inside) out.vertex[static_cast<std::size_t>(out.count++)] = a;
        if (a_inside != b_inside) {
            out.vertex[static_cast<std::size_t>(out.count++)] =
                a_inside ? intersect(a, da, b, db) : intersect(b, db, a, da);
        }
    }
    polygon = out;
}

} // namespace

void clip(ClipPolygon& polygon, double near_w) {
    for (int plane = 0; plane < kPlanes && polygon.count >= 3; ++plane)
        clip_plane(polygon, plane, near_w);
}

bool clip(ClipVertex& a, ClipVertex& b, double near_w) {
    for (int plane = 0; plane < kPlanes; ++plane) {
        const double da = distance(plane, a, near_w), db = distance(plane, b, near_w);
        if (da < 0 && db < 0) return false;
        if (da < 0) a = intersect(b, db, a, da);
        if (db < 0) b = intersect(a, da, b, db);
    }
    return true;
}

} // namespace scanout::raster
