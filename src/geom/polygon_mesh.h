// The contents of a mesh file before any decision about them: polygons of any size, polylines and
// points in file units, in double. io fills it; geom/build.h makes a drawable Mesh of it.
#pragma once

#include "math/vec.h"

#include <cstdint>
#include <vector>

namespace scanout::geom {

// One corner of a polygon: indices into PolygonMesh's arrays, -1 where the file gives none.
struct Corner {
    std::int32_t position = -1, uv = -1, normal = -1;
};

// Smoothing groups: faces of one group share normals across their common vertices.
inline constexpr std::uint32_t kSmoothingOff = 0;            // "s off": flat
inline constexpr std::uint32_t kSmoothingUnset = 0xffffffff; // no s statement: by crease angle

struct PolygonMesh {
    std::vector<DVec3> positions; // file units
    std::vector<Vec3> colours;    // linear, one a position; empty when the file has none
    std::vector<DVec2> uvs;       // v runs up
    std::vector<Vec3> normals;    // any length; zero or not finite = missing

    std::vector<Corner> corners; // of all faces, one after the other
    std::vector<std::uint32_t>
        face_begin; // first corner of each face; faces end where the next begins
    std::vector<std::int32_t> face_material; // index of a scene material, -1 none; one a face
    std::vector<std::uint32_t>
        face_smoothing; // one a face, or empty when every face is kSmoothingUnset

    std::vector<std::uint32_t> line_vertices; // polylines: position indices, one after the other
    std::vector<std::uint32_t> line_begin;    // first entry of each polyline
    std::vector<std::int32_t> line_material;  // one a polyline

    std::vector<std::uint32_t> point_vertices;
    std::vector<std::int32_t> point_material; // one a point

    std::size_t faces() const { return face_begin.size(); }
    std::size_t face_end(std::size_t face) const {
        return face + 1 < face_begin.size() ? face_begin[face + 1] : corners.size();
    }
};

} // namespace scanout::geom
