// PolygonMesh -> Mesh: bad faces out, polygons cut into triangles, equal corners joined, missing
// normals made, coordinates normalised. Order of triangles = order of faces in the file.
#pragma once

#include "base/jobs.h"
#include "base/warnings.h"
#include "geom/mesh.h"
#include "geom/polygon_mesh.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>

namespace scanout::geom {

struct BuildOptions {
    double crease_degrees = 60; // where the file has neither normals nor smoothing groups
    Jobs* jobs = nullptr;       // null: on one thread. The mesh does not depend on it
    // By material: by multiples of how much a face's texture coordinates may move without a change
    // of what its maps show; 0: by nothing. Of what has no entry: 2, an even number of repeats,
    // which change nothing where they are mirrored, either.
    std::vector<DVec2> uv_step = {};
    // The box that the mesh is framed by, in place of its own: it lies within.
    std::optional<std::pair<DVec3, DVec3>> reach = std::nullopt;
    // Called now and then with the share that is done, 0 to 1; false stops the work.
    std::function<bool(double)> progress = nullptr;
};

struct BuildResult {
    Mesh mesh;
    std::size_t skipped_faces = 0; // fewer than three corners, or a position that is not finite
    std::size_t skipped_lines = 0; // polylines with a position that is not finite
    std::size_t skipped_points = 0;
    bool stopped = false; // by progress: the mesh is of no use
};

// Takes the PolygonMesh and frees its arrays. `name` stands in warnings. Never fails: what can be
// shown is shown, an empty mesh included. Indices of the PolygonMesh must lie within its arrays.
//
// Vertices that are equal bit for bit (-0 counts as 0) are one; they are numbered in the order of
// first use: by the faces' corners, then lines, then points; where triangles lie in no order, by
// place (geom/spatial_order.h).
BuildResult build_mesh(PolygonMesh&& polygons, const BuildOptions& options, const std::string& name,
                       Warnings& warnings);

} // namespace scanout::geom
