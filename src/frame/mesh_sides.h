// Can the back of a face be seen? Facts about a mesh's winding and normals, in one pass over its
// triangles.
#pragma once

#include "geom/mesh.h"

#include <cstddef>

namespace scanout::frame {

struct MeshSides {
    // Every edge is used as often in one direction as in the other, by position: from outside, the
    // backs of its faces lie behind their fronts.
    bool closed = false;
    bool outward = false; // its volume is positive: it is not wound inside out
    // Triangles with a normal that does not lie clearly on the side from which they wind counter-
    // clockwise; those without an area, too.
    std::size_t leaning = 0;
};
MeshSides mesh_sides(const geom::Mesh& mesh);

} // namespace scanout::frame
