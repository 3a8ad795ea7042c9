// Clusters (meshlets): groups of neighbouring triangles with their bounds. A frame skips whole
// groups that face away or lie beside the picture, and the vertices that only they use. A
// triangle's spatial index is its position in the order of all clusters.
#pragma once

#include "base/jobs.h"
#include "math/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace scanout::geom {

struct Mesh;

struct Cluster {
    DVec3 centre; // of a sphere that holds all its triangles; mesh space
    double radius;
    // Each triangle's normal lies within a cone about the axis; spread: the sine of the angle
    // between its axis and its side, 2 where it is as wide as a half space.
    DVec3 axis;
    double spread;
    double thinnest; // least height over the longest side of a triangle; 0 without area
};

// Mesh space.
struct Sphere {
    DVec3 centre;
    double radius;
};

struct Clusters {
    static constexpr std::size_t kTriangles =
        32; // a cluster, in spatial order; the last may have fewer
    static constexpr std::size_t kGroup = 64;         // clusters in a row; likewise
    static constexpr std::size_t kGroupVertices = 16; // a vertex group, by number

    std::vector<Cluster> cluster;
    std::vector<Sphere> group; // bounding spheres of groups of clusters
    // The vertex groups that a cluster uses: vertex_groups[begin[c]] up to [begin[c + 1]].
    std::vector<std::uint32_t> begin, vertex_groups;
    // In spatial order: triangles' numbers in the mesh, and their vertices, three each; and, by
    // number, their spatial index. Empty where the spatial order is the mesh's own.
    std::vector<std::uint32_t> triangle, index, spatial_index;

    bool empty() const { return cluster.empty(); }
    std::span<const std::uint32_t> vertex_groups_of(std::size_t c) const {
        return std::span(vertex_groups).subspan(begin[c], begin[c + 1] - begin[c]);
    }
};

// Clusters of all triangles of the mesh. order: their spatial order (geom/spatial_order.h); empty:
// the mesh's own.
Clusters find_clusters(Jobs& jobs, const Mesh& mesh, std::vector<std::uint32_t> order = {});

} // namespace scanout::geom
