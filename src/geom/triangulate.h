// A polygon into triangles. Ear clipping with an exact orientation test; concave, collinear,
// self-touching and non-planar polygons; convex ones as a fan. Meisters 1975, [Primer 8.2].
#pragma once

#include "math/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace scanout::geom {

// The polygon's normal by Newell's method (length = twice the area; zero when degenerate). Taken
// relative to the first corner, so that a polygon far from the origin keeps its digits.
DVec3 newell_normal(std::span<const DVec3> polygon);

// Appends (n - 2) triples of corner numbers in [0, n) to `out`, wound as the polygon is. The
// polygon is projected along the largest axis of its Newell normal. Always ends and always gives n
// - 2 triangles; where no ear is left (self-crossing outlines), or a hostile outline would take
// minutes, the rest becomes a fan. Convex polygons become the fan about corner 0. Coordinates:
// finite, below 1e150 in magnitude (products must not overflow).
void triangulate(std::span<const DVec3> polygon, std::vector<std::uint32_t>& out);

} // namespace scanout::geom
