// PolygonMesh -> Mesh: bad faces out, polygons cut into triangles, equal corners joined, missing
// normals made, coordinates normalised. Order of triangles = order of faces in the file.
#pragma once

#include "base/warnings.h"
#include "geom/mesh.h"
#include "geom/polygon_mesh.h"

#include <string>

namespace scanout::geom {

struct BuildOptions {
    double crease_degrees = 60; // where the file has neither normals nor smoothing groups
};

struct BuildResult {
    Mesh mesh;
    std::size_t skipped_faces = 0; // fewer than three corners, or a position that is not finite
    std::size_t skipped_lines = 0; // polylines with a position that is not finite
    std::size_t skipped_points = 0;
};

// Takes the PolygonMesh and frees its arrays. `name` stands in warnings. Never fails: what can be
// shown is shown, an empty mesh included. Indices of the PolygonMesh must lie within its arrays.
//
// Vertices that are equal bit for bit (-0 counts as 0) are one; they are numbered in the order of
// first use: by the faces' corners, then lines, then points.
BuildResult build_mesh(PolygonMesh&& polygons, const BuildOptions& options, const std::string& name,
                       Warnings& warnings);

} // namespace scanout::geom
