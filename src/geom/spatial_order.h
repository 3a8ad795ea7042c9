// Spatial order of triangles, by median splits, for files whose neighbours are far apart, such as
// those of scanners and of programs that merge scans. The mesh keeps the order of the file, because
// it decides visibility at equal depth; loops over triangles may use the spatial order instead
// (geom/clusters.h).
#pragma once

#include "base/jobs.h"
#include "geom/mesh.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace scanout::geom {

// The triangles' numbers in an order in which each run of Clusters::kTriangles is compact. Empty,
// which means the file's order, where triangles are few or compact enough already, and where the
// new order would be no better. Positions are finite. go_on gets the share that is done; returns
// false where go_on stopped it.
bool spatial_order(Jobs& jobs, const Mesh& mesh, std::vector<std::uint32_t>& order,
                   const std::function<bool(double)>& go_on);

// Sorts the vertices by their first use by these triangles, so that vertices that are read together
// lie together; then come vertices that only lines and points use, in their old order. Call it
// before line faces are found.
void order_vertices(Jobs& jobs, Mesh& mesh, std::span<const std::uint32_t> triangles);

} // namespace scanout::geom
