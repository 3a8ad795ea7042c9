// Triangles as files hold them, for the tests and benchmarks of loading.
#pragma once

#include "base/result.h"
#include "geom/polygon_mesh.h"

#include <string>

namespace scanout::bench {

// Binary STL: 84 bytes and 50 a triangle. The mesh has triangles alone.
std::string binary_stl(const geom::PolygonMesh& mesh);
// Positions with six digits, and faces of three.
std::string obj_text(const geom::PolygonMesh& mesh);

// By the name's end, .stl or .obj; Exit::usage for another.
Result<void> write_mesh(const geom::PolygonMesh& mesh, const std::string& path);

} // namespace scanout::bench
