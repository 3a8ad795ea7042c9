// The diagnosis of a model: numeric and topological hazards of the polygons that its file holds.
// Time grows as n log n, but for surfaces that overlap or intersect very often.
#pragma once

#include "base/jobs.h"
#include "geom/diagnose/diagnosis.h"
#include "geom/polygon_mesh.h"

#include <functional>
#include <vector>

namespace scanout::geom {

struct DiagnoseOptions {
    // Lengths in bounding radii. A T-vertex or a crack is at most as wide as `tolerance`, and as
    // kSeamShare of the edge's length; surfaces closer than `gap` are in one plane.
    double tolerance = 1e-3;
    double gap = 0x1p-20;
    double touch = 0x1p-20; // triangles that reach less far into each other only touch
    // Material -> has a map; faces with others need no texture coordinates.
    std::vector<bool> textured;
    bool search = true;  // for seams, overlaps and intersections
    double seconds = 60; // of search; what is left then is not searched
    // Called with the share that is done, on the calling thread; false: no further.
    std::function<bool(double)> progress;
};
inline constexpr double kSeamShare = 0.01;

// Indices must lie within the mesh's arrays.
Diagnosis diagnose(Jobs& jobs, const PolygonMesh& mesh, const DiagnoseOptions& how);

} // namespace scanout::geom
