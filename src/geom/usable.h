// Which faces of a PolygonMesh can be drawn, and which of its positions anything uses.
#pragma once

#include "base/jobs.h"
#include "geom/polygon_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace scanout::geom {

// Faces are worked on in chunks of so many: a multiple of the bits in a word of Usable::face, so
// that no two threads write one word.
inline constexpr std::size_t kFaceChunk = 1024;

// Which faces can be drawn, and which positions anything uses.
struct Usable {
    struct FaceChunk { // of faces: those that can be drawn
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
