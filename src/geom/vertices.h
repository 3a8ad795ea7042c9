// The vertices of a Mesh: face corners that are equal in everything that is drawn become one.
#pragma once

#include "geom/join_table.h"
#include "geom/mesh.h"
#include "geom/polygon_mesh.h"

#include <cstdint>
#include <memory>
#include <span>

namespace scanout::geom {

// Numbers the corners so that corners of the same vertex get the same number. The design saves
// memory: where faces are flat, the vertices are the largest array of all, and must not exist
// beside the corners and a table that both still grow. So a vertex is at first only a corner,
// stored in the place of a finished corner (vertex i comes of corner i or a later one); write()
// makes the arrays in their final size when everything else is freed.
class Vertices {
public:
    Vertices(Jobs& jobs, PolygonMesh& polygons, std::size_t expected);

    // The vertex of each corner, good until the next call. Overwrites the mesh's corners up to the
    // number of corners so far: all faces' corners must be asked for, in their order, and `corners`
    // must not be theirs.
    std::span<const std::uint32_t> numbers_of(std::span<const Corner> corners);

    // Frees the table, and the corners as it goes.
    void write(Mesh& mesh, bool with_uv, bool with_colour);

private:
    Jobs& jobs_;
    PolygonMesh& m_;
    std::unique_ptr<JoinTable> table_;
};

} // namespace scanout::geom
