// Clipping in homogeneous coordinates, before the divide: triangles against the near plane
// (Sutherland and Hodgman 1974), segments against the guard band, too; [Compendium 7, 8],
// [ClipSpace 6, 7], [SoftwareGraphics]. Every intersection is computed from the inside vertex to
// the outside one, so an edge that two triangles share is cut at the same point in both
// (Ericson 2005, 8.3.5; HARD-CASES 9, 13).
#pragma once

#include "raster/screen/screen.h"

#include <array>
#include <cstdint>

namespace scanout::raster {

// A point on a triangle's edge: the share `t` of the way from one vertex to another; or a vertex,
// then `from` and `to` are the same.
struct EdgePoint {
    std::uint8_t from = 0, to = 0; // vertex numbers, 0 to 2
    double t = 0;
    bool cut() const { return from != to; }
};

// The part of a triangle before the near plane, in the order of its vertices; empty when there is
// none.
struct NearPolygon {
    std::array<ClipVertex, 4> vertex;
    std::array<EdgePoint, 4> edge_point; // cuts from the inside vertex
    int count = 0;
};
NearPolygon cut_near(const std::array<ClipVertex, 3>& triangle, double near_w);

// A segment, cut by the near plane and the guard band's four sides; false when nothing is left.
bool clip(ClipVertex& a, ClipVertex& b, const ClipBox& box);

} // namespace scanout::raster
