// Outlines in a plane: directed edges joined to closed loops, and loops to polygons with holes.
#pragma once

#include "math/vec.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::geom {

// Between two points, by number. What it bounds lies to its left.
struct OutlineEdge {
    std::uint32_t from, to;
};

// Closed. Its points wind counter-clockwise, but for those of a hole.
struct Loop {
    std::vector<std::uint32_t> points;
    bool turned = false; // its edges ran the other way: it is wound so that it can be filled
};

struct Polygon {
    Loop outline;
    std::vector<Loop> holes;
};

struct Outlines {
    std::vector<Polygon> polygons;
    std::size_t open_edges = 0; // in no loop
};

// Edges that run against their neighbours are joined to them all the same. At a point where loops
// touch, they are told apart by angles, exactly.
//
// A loop that runs clockwise is a hole of the smallest counter-clockwise one around it; without
// one it is an outline that is turned. What runs both ways is an outline or a hole by how many
// loops lie around it. Loops of different components may overlap: each is filled.
Outlines find_outlines(std::span<const DVec2> points, std::span<const OutlineEdge> edges);

// Appends triangles of the polygon's points to `out`, counter-clockwise, three each. Triangles
// with two corners at one point are left out.
void triangulate(std::span<const DVec2> points, const Polygon& polygon,
                 std::vector<std::uint32_t>& out);

} // namespace scanout::geom
