// Spatial order of triangles, by median splits, for files that have them in no order: scanners, and
// what merges their pictures, leave neighbours far apart. The mesh keeps the order of the file,
// which decides what is visible where depths are equal; loops over triangles may use the spatial
// order (geom/clusters.h).
#pragma once

#include "base/jobs.h"
#include "geom/mesh.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace scanout::geom {

// The triangles' numbers in an order in which each run of Clusters::kTriangles lies together.
// Empty, for the order of the file, where they are few, where they lie together well enough, and
// where that would bring them no nearer. Positions are finite. go_on gets the share that is done;
// returns false where that stopped it.
bool spatial_order(Jobs& jobs, const Mesh& mesh, std::vector<std::uint32_t>& order,
                   const std::function<bool(double)>& go_on);

// Puts the vertices in the order in which these triangles use them first, so that what is read
// together lies together; then those of lines and points alone, as they were. Line faces are not
// found yet.
void order_vertices(Jobs& jobs, Mesh& mesh, std::span<const std::uint32_t> triangles);

} // namespace scanout::geom
