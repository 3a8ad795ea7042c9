// A mesh ready to draw: triangles, line segments and points over shared vertices. Positions are
// normalised: position = (file position - centre) * 2^-exponent, computed in double and rounded
// once, so that the framing sphere's radius lies in [0.5, 1] and no model is too far or too small.
#pragma once

#include "geom/clusters.h"
#include "math/vec.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::geom {

// For every line segment, the faces that it lies on, each by its first triangle. Segments between
// the same two places share a list. Empty when no line lies on a face.
struct LineFaces {
    std::vector<std::uint32_t> list;     // one a segment
    std::vector<std::uint32_t> begin;    // of each list in `triangle`, and the end of the last
    std::vector<std::uint32_t> triangle; // ascending in each list

    std::span<const std::uint32_t> of(std::size_t segment) const {
        if (list.empty()) return {};
        const std::size_t i = list[segment];
        return std::span(triangle).subspan(begin[i], begin[i + 1] - begin[i]);
    }
};

struct Mesh {
    // Vertices, one entry each. normal is of unit length. uv and colour are empty when no face has
    // them.
    std::vector<Vec3> position;
    std::vector<Vec3> normal;
    std::vector<Vec2> uv;     // v runs up; u and v of a face are moved by whole numbers towards 0
    std::vector<Vec3> colour; // linear

    // uv before they were rounded to floats, where some are beyond kLargeUv; else empty. A face
    // with 100 000 repeats of a texture has more texels than a float has numbers (HARD-CASES 36).
    static constexpr float kLargeUv = 64;
    std::vector<DVec2> exact_uv;
    DVec2 uv_of(std::uint32_t vertex) const {
        return exact_uv.empty() ? DVec2(uv[vertex]) : exact_uv[vertex];
    }

    // Triangles in file order: three vertex indices each.
    std::vector<std::uint32_t> index;
    std::vector<std::int32_t> material; // one a triangle, -1 none
    std::vector<std::uint32_t> face;    // one a triangle: the face of the file that it is part of

    // Clusters of the triangles; empty: none are known, and frames test every triangle.
    Clusters clusters;
    // Triangles in spatial order (geom/clusters.h): their vertices, three each, and their numbers.
    std::span<const std::uint32_t> index_in_spatial_order() const {
        return clusters.index.empty() ? index : clusters.index;
    }
    std::uint32_t triangle_at(std::uint32_t spatial_index) const {
        return clusters.triangle.empty() ? spatial_index : clusters.triangle[spatial_index];
    }

    std::vector<std::uint32_t> line_index;   // two vertex indices a segment
    std::vector<std::int32_t> line_material; // one a segment
    LineFaces line_faces;
    std::vector<std::uint32_t> point_index; // one vertex index a point
    std::vector<std::int32_t> point_material;

    // The framing sphere: about the middle of the bounding box of the vertices that something uses
    // (of all vertices, when nothing does). By min and max alone: no order of vertices can move it.
    DVec3 centre{0};              // file units
    int exponent = 0;             // file units = normalised * 2^exponent
    double radius = 0.5;          // normalised; 0.5 when the mesh is empty or a single point
    DVec3 box_min{0}, box_max{0}; // file units

    std::size_t triangles() const { return index.size() / 3; }
    std::size_t lines() const { return line_index.size() / 2; }
    std::size_t points() const { return point_index.size(); }
};

} // namespace scanout::geom
