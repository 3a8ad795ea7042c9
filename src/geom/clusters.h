// Triangles in groups of neighbours, with what bounds them: a frame passes over whole groups that
// face away or lie beside the picture, and over the vertices that only they have. A triangle's
// place says where it stands among them all.
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
    double thinnest; // the least height over a triangle's longest side; 0 where one has no area
};

// Mesh space.
struct Sphere {
    DVec3 centre;
    double radius;
};

struct Clusters {
    static constexpr std::size_t kTriangles = 32; // a cluster, by place; the last may have fewer
    static constexpr std::size_t kGroup = 64;     // clusters in a row; likewise
    static constexpr std::size_t kVertices = 16;  // a block of vertices, by number

    std::vector<Cluster> cluster;
    std::vector<Sphere> group; // hold those of their clusters
    // The blocks of vertices that a cluster has: blocks[begin[c]] up to blocks[begin[c + 1]].
    std::vector<std::uint32_t> begin, blocks;
    // By place: triangles' numbers in the mesh, and their vertices, three each; and by number their
    // places. Empty where places are these numbers.
    std::vector<std::uint32_t> triangle, index, place;

    bool empty() const { return cluster.empty(); }
    std::span<const std::uint32_t> blocks_of(std::size_t c) const {
        return std::span(blocks).subspan(begin[c], begin[c + 1] - begin[c]);
    }
};

// Those of all triangles of the mesh, in this order (geom/place_order.h); empty: as it has them.
Clusters find_clusters(Jobs& jobs, const Mesh& mesh, std::vector<std::uint32_t> order = {});

} // namespace scanout::geom
