// Triangles in the order of their places, for files that have them in no order: scanners, and what
// merges their pictures, leave neighbours far apart.
#pragma once

#include "base/jobs.h"
#include "geom/mesh.h"

namespace scanout::geom {

// Puts the triangles in an order in which each run of Clusters::kTriangles lies together, and the
// vertices in the order in which these use them first, so that what is read together lies together.
// Leaves all as it is where they are few, where they lie together well enough, where that would
// bring them no nearer, and where there are lines: what asks whether these lie on a face asks for
// its triangles side by side (raster/ground.h). Of triangles that stand in one place the first in
// the file stays the first; of others with one depth at a sample the first in the new order is
// seen. Positions are finite, and clusters not found yet.
void order_by_place(Jobs& jobs, Mesh& mesh);

} // namespace scanout::geom
