// Triangles in the order of their places, for files that have them in no order: scanners, and what
// merges their pictures, leave neighbours far apart.
#pragma once

#include "base/jobs.h"
#include "geom/mesh.h"

namespace scanout::geom {

// Puts the triangles in an order in which each run of Clusters::kTriangles lies together, and the
// vertices in the order in which these use them first, so that what is read together lies together.
// Leaves all as it is where they lie together well enough, and where they are few. Of triangles
// that stand in one place the first in the file stays the first. Not with lines' faces, which name
// triangles.
void order_by_place(Jobs& jobs, Mesh& mesh);

} // namespace scanout::geom
