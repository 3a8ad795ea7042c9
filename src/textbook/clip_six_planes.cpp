// Clipping in homogeneous space, before the division [Compendium 8.3], [ClipSpace 5-8],
// [SoftwareGraphics]: Sutherland and Hodgman 1974 with the six planes -w <= x, y, z <= w.
#include "textbook/clip.h"

namespace scanout::textbook {

Polygon clip_by_plane(const Polygon& polygon, const Plane& plane) {
    Polygon out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double from = plane.distance(a.clip), to = plane.distance(b.clip);
        if (from >= 0) out.push_back(a);
        if ((from >= 0) != (to >= 0)) out.push_back(mix(a, b, from / (from - to)));
    }
    return out;
}

Polygon clip_six_planes(Polygon polygon, const std::vector<Plane>& planes) {
    for (const Plane& plane : planes)
        polygon = clip_by_plane(polygon, plane);
    if (polygon.size() < 3) polygon.clear();
    return polygon;
}

} // namespace scanout::textbook
