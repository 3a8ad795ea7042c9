// Clipping in homogeneous coordinates, before the divide: triangles against the near plane
// (Sutherland-Hodgman), segments against the guard band, too [A ch.7-8], [A'], [D]. Every
// intersection is computed from the inside vertex to the outside one, so an edge that two triangles
// share is cut at the same point in both (Ericson, Real-Time Collision Detection, 8.3.5;
// HARD-CASES 9, 13).
#pragma once

#include "raster/primitive.h"
#include "raster/screen.h"

#include <array>

namespace scanout::raster {

// A triangle before the divide, in canonical order (lowest y, x, w first), so that no bit depends
// on the order in which a file names its vertices. Olano and Greer, "Triangle Scan Conversion Using
// 2D Homogeneous Coordinates", 1997.
struct HomogeneousTriangle {
    CanonicalOrder order;
    bool clockwise; // in canonical order, on the screen where it is visible
    // weight_i = row_i . (x, y, 1) at a pixel: the perspective-correct weight of the vertex in
    // place i, up to a common factor; none is negative inside.
    std::array<DVec3, 3> row;
};
HomogeneousTriangle homogeneous_triangle(const std::array<ClipVertex, 3>& vertex);

// What lies before the near plane, in the order of the triangle's vertices; empty when nothing
// does.
struct NearPolygon {
    std::array<ClipVertex, 4> vertex;
    std::array<int, 4> corner; // which vertex of the triangle it is; -1: where an edge is cut
    int count = 0;
};
NearPolygon cut_near(const std::array<ClipVertex, 3>& triangle, double near_w);

// A segment, cut by the near plane and the guard band's four sides; false when nothing is left.
bool clip(ClipVertex& a, ClipVertex& b, const ClipBox& box);

} // namespace scanout::raster
