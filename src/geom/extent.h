// Area and volume of a mesh, in the units of its file.
#pragma once

#include "geom/mesh.h"

namespace scanout::geom {

// Of the mesh before any transform; its positions are rounded to 2^-24 of its size. Sums run in the
// order of the triangles, in double.
double surface_area(const Mesh& mesh); // units squared, both sides of a sheet count once

// Units cubed, by the divergence theorem: of a closed mesh that is wound outwards what it encloses,
// less than 0 where it is wound inwards; nothing else's.
double enclosed_volume(const Mesh& mesh);

} // namespace scanout::geom
