// The places of a mesh's vertices: vertices at equal positions have one, whatever their normals and
// uv.
#pragma once

#include "geom/mesh.h"

#include <cstdint>
#include <vector>

namespace scanout::geom {

struct MeshPlaces {
    std::vector<std::uint32_t> of_vertex; // numbers of places, in the order of x, y, z
    std::vector<std::uint32_t> vertex;    // one at each place
};
MeshPlaces find_places(const Mesh& mesh);

// Of every triangle, the part that it belongs to: parts are triangles connected by places. Numbered
// in the order of their first triangles.
std::vector<std::uint32_t> find_parts(const Mesh& mesh);

} // namespace scanout::geom
