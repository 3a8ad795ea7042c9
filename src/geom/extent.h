// Area and volume of a mesh, in the units of its file.
#pragma once

#include "geom/mesh.h"

#include <optional>

namespace scanout::geom {

// Of the mesh before any transform; its positions are rounded to 2^-24 of its size. Sums run in the
// order of the triangles, in double. A number is missing where it lies outside of a double's normal
// range: the volume of a model of 1e120 units, or of 1e-120.
struct Extent {
    bool has_area = false;
    std::optional<double> area; // units squared, both sides of a sheet count once
    // Units cubed, by the divergence theorem: of a closed mesh that is wound outwards what it
    // encloses, less than 0 where it is wound inwards; nothing else's.
    std::optional<double> volume;
};
Extent extent_of(const Mesh& mesh);

} // namespace scanout::geom
