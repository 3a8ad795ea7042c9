// T-vertices become corners of the faces on whose edges they lie: the surface closes, and no vertex
// moves. The one step of mending that draws a different picture.
#pragma once

#include "base/jobs.h"
#include "geom/polygon_mesh.h"

#include <cstddef>
#include <cstdint>

namespace scanout::geom {

struct SplitEdges {
    std::size_t corners = 0;    // that were put into edges
    double farthest = 0;        // of them from its edge, file units
    std::size_t unsearched = 0; // open edges, where they are more than kMostOpenEdges, or crowded
    bool crowded = false;       // Seams::crowded
};

// A heap of faces, such as leaves or hair, has no seams, but the search would take many times as
// long as reading it: a model with more open edges is not searched for TVertices::seams.
inline constexpr std::size_t kMostOpenEdges = 200'000;

// seams: where two surfaces meet along the edge; those of sheets whose faces have turned twins may
// be left out, so that closed models cost little. all: also vertices that only touch an edge.
enum class TVertices : std::uint8_t { seams, all };

// `tolerance`: in bounding radii (DiagnoseOptions). Indices must lie within the mesh's arrays.
// Texture coordinates and normals of a new corner are interpolated along its edge. Searches open
// edges alone (geom/open_edges.h).
SplitEdges split_t_vertices(Jobs& jobs, PolygonMesh& mesh, double tolerance,
                            TVertices which = TVertices::all);

} // namespace scanout::geom
