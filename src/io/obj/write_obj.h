// Polygons -> Wavefront OBJ: positions and texture coordinates with as many digits as give the same
// doubles again, normals likewise as floats, materials by name, smoothing groups, lines and points.
#pragma once

#include "geom/polygon_mesh.h"

#include <span>
#include <string>

namespace scanout::io {

// `materials`: names of the mesh's materials; one of no name is left out. `libraries`: file names,
// one a mtllib line. Colours of vertices are written as display values of six digits.
std::string obj_text(const geom::PolygonMesh& mesh, std::span<const std::string> materials,
                     std::span<const std::string> libraries);

} // namespace scanout::io
