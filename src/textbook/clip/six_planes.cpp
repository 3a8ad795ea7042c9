// Clipping in homogeneous space, before the division [Compendium 8.3], [ClipSpace 5-8],
// [SoftwareGraphics]: Sutherland and Hodgman 1974 with the six planes -w <= x, y, z <= w.
#include "textbook/clip/clip.h"

namespace scanout::textbook {

Polygon clip_by_plane(const Polygon& polygon, const Plane& plane) {
    return clip_by_side(polygon, [&](const Vertex& v) { return plane.distance(v.clip); });
}

Polygon clip_six_planes(Polygon polygon, const std::vector<Plane>& planes) {
    for (const Plane& plane : planes)
        polygon = clip_by_plane(polygon, plane);
    if (polygon.size() < 3) polygon.clear();
    return polygon;
}

} // namespace scanout::textbook
