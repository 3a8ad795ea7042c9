// Missing normals: the sum of the adjoining faces' unit normals, weighted by the angle at the corner
// (Thürmer and Wüthrich 1998), split by smoothing group or crease angle. The sum is taken in 64-bit
// fixed point, so it does not depend on the order of the faces.
#pragma once

#include "geom/polygon_mesh.h"

#include <cstdint>
#include <vector>

namespace scanout::geom {

// One unit normal for every corner of `polygons` (in the order of its corners), whether or not the
// file gives one. Corners of degenerate faces get (0, 0, 1) when nothing better is known.
std::vector<Vec3> corner_normals(const PolygonMesh& polygons, double crease_degrees);

}  // namespace scanout::geom
