// Clipping in homogeneous coordinates, before the divide: Sutherland-Hodgman against the near plane
// and the guard band [A ch.7-8], [A'], [D]. Every intersection is computed from the inside vertex
// to the outside one, so an edge that two triangles share is cut at the same point in both
// (Ericson, Real-Time Collision Detection, 8.3.5; HARD-CASES 9, 12, 13).
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
    bool seen;      // false: edge-on or a point, it covers nothing
    // weight_i = row_i . (x, y, 1) at a pixel: the perspective-correct weight of the vertex in
    // place i, up to a common factor; none is negative inside.
    std::array<DVec3, 3> row;
};
HomogeneousTriangle homogeneous_triangle(const std::array<ClipVertex, 3>& vertex);

// A triangle cut by five planes: 8 vertices if it stays convex; the room is for the worst that
// rounding could make of it (each plane adds at most half as many vertices again).
struct ClipPolygon {
    std::array<ClipVertex, 20> vertex;
    int count = 0;
};

// polygon: inside the box afterwards; count < 3 when nothing is left.
void clip(ClipPolygon& polygon, const ClipBox& box);

// A segment likewise; false when nothing is left.
bool clip(ClipVertex& a, ClipVertex& b, const ClipBox& box);

} // namespace scanout::raster
