// Missing normals: the sum of the adjoining faces' unit normals, weighted by the angle at the
// corner (Thürmer and Wüthrich 1998), split by smoothing group or crease angle. The sum is taken in
// 64-bit fixed point, so it does not depend on the order of the faces.
#pragma once

#include "base/jobs.h"
#include "geom/polygon_mesh.h"

#include <functional>
#include <vector>

namespace scanout::geom {

// Gives every corner of the usable faces a unit normal (to 1e-6, never NaN): Corner::normal becomes
// an index into polygons.normals, which is normalised in place and grows by the normals made.
//
// - A normal of the file is kept where it is finite and not zero; others are made.
// - Faces with the same smoothing group share a normal at a common position (by index). If no group
// is set, each corner takes the sum over all faces whose normal is within the crease angle of its
// own face's. kSmoothingOff gives the face's normal.
// - Degenerate faces add nothing. A sum of zero gives the face's normal; if that is zero, (0, 0,
// 1).
//
// positions of usable faces must be finite and within [-1, 1] (as Framing::normalise makes them).
// `go_on` gets the share that is done, 0 to 1, from time to time; if it returns false, make_normals
// stops and returns false.
bool make_normals(Jobs& jobs, PolygonMesh& polygons, const std::vector<bool>& usable,
                  double crease_degrees, const std::function<bool(double)>& go_on = nullptr);

} // namespace scanout::geom
