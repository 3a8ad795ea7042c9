// Finds the faces of a PolygonMesh that can be drawn, and the positions that are used.
#pragma once

#include "base/jobs.h"
#include "geom/polygon_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scanout::geom {

// Faces are processed in chunks of this size: a multiple of the bits in a word of Usable::face, so
// that no two threads write one word.
inline constexpr std::size_t kFaceChunk = 1024;

// The faces that can be drawn, and the positions that faces, lines or points use.
struct Usable {
    struct FaceChunk { // counts of the drawable faces
        std::size_t faces = 0, corners = 0, triangles = 0;
        bool uv = false;
    };
    std::vector<bool> face;
    std::vector<std::uint8_t> position;
    std::vector<FaceChunk> chunks;
    FaceChunk all;

    // Indices must lie within the mesh's arrays.
    Usable(Jobs& jobs, const PolygonMesh& m);

private:
    void add_face(const PolygonMesh& m, std::size_t f, FaceChunk& chunk);
    void use(const PolygonMesh& m, std::uint32_t p);
};

} // namespace scanout::geom
