// Cutting off what leaves the view: faces and lines, as the documents have it.
#pragma once

#include "textbook/triangle.h"

#include <optional>
#include <utility>
#include <vector>

namespace scanout::textbook {

// Inside: normal . clip + offset >= 0.
struct Plane {
    DVec4 normal{0};
    double offset = 0;
    double distance(const DVec4& p) const {
        return ((normal.x * p.x + normal.y * p.y) + (normal.z * p.z + normal.w * p.w)) + offset;
    }
};
using Polygon = std::vector<Vertex>;

// Sutherland and Hodgman 1974: of a polygon what lies where distance(corner) is 0 or above, in
// homogeneous space or on the screen. t = a / (a - b) of the distances of an edge's ends, whose
// difference is never 0, because one end is inside and the other is not.
template <class OneCorner, class Distance>
std::vector<OneCorner> clip_by_side(const std::vector<OneCorner>& polygon, Distance distance) {
    std::vector<OneCorner> out;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const OneCorner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const double from = distance(a), to = distance(b);
        if (from >= 0) out.push_back(a);
        if ((from >= 0) != (to >= 0)) out.push_back(mix(a, b, from / (from - to)));
    }
    return out;
}

// One plane [ClipSpace 6], [SoftwareGraphics].
Polygon clip_by_plane(const Polygon& polygon, const Plane& plane);
// [Compendium 8.3]: the planes one after the other: 0, or 3 to 9 corners. A cut may lie outside of
// the planes that are still to come.
Polygon clip_six_planes(Polygon polygon, const std::vector<Plane>& planes);
// [Course 5.2]: 3, 0, 1 or 2 corners inside give 1, 0, 1 or 2 triangles, wound as before.
std::vector<std::array<Vertex, 3>> clip_four_cases(const std::array<Vertex, 3>& triangle,
                                                   const Plane& plane);
// A fan [ClipSpace 7]: P0 P1 P2, P0 P2 P3 ...
template <class Of>
void for_each_of_fan(const Polygon& polygon, Of of) {
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        of(std::array<Vertex, 3>{polygon[0], polygon[i], polygon[i + 1]});
}

// Sutherland and Hodgman 1974, against each side of any convex window whose corners run clockwise
// on the screen. After the division: values are cut by 1/w.
std::vector<Corner> clip_sutherland_hodgman(std::vector<Corner> polygon,
                                            const std::vector<DVec2>& window);

// Both sides included.
struct Box {
    double left, top, right, bottom;
};
using Segment = std::pair<DVec2, DVec2>;
using LineClip = std::optional<Segment> (*)(const Segment& line, const Box& box);
// The part of a line in the box; nothing where there is none.
std::optional<Segment> clip_cohen_sutherland(const Segment& line, const Box& box);
std::optional<Segment> clip_midpoint_subdivision(const Segment& line, const Box& box);
std::optional<Segment> clip_liang_barsky(const Segment& line, const Box& box);
LineClip line_clip(Clip clip);

} // namespace scanout::textbook
