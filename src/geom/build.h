// PolygonMesh -> Mesh: bad faces out, polygons cut into triangles, equal corners joined, missing
// normals made, coordinates normalised. Order of triangles = order of faces in the file.
#pragma once

#include "base/warnings.h"
#include "geom/mesh.h"
#include "geom/polygon_mesh.h"

#include <string>

namespace scanout::geom {

struct BuildOptions {
    double crease_degrees = 60;  // where the file has neither normals nor smoothing groups
};

struct BuildResult {
    Mesh mesh;
    std::size_t skipped_faces = 0;  // faces with a position that is not finite, or with no corner left
};

// Takes the PolygonMesh and frees its arrays as soon as each has served. `name` stands in warnings.
// Never fails: what can be shown is shown, an empty mesh included.
BuildResult build_mesh(PolygonMesh&& polygons, const BuildOptions& options, const std::string& name,
                       Warnings& warnings);

}  // namespace scanout::geom
