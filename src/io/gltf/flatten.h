// Primitives in their places -> the polygons of one mesh.
#pragma once

#include "base/warnings.h"
#include "geom/polygon_mesh.h"
#include "io/gltf/material.h"
#include "io/gltf/primitive.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace scanout::io::gltf {

// A frame indexes as many vertices; corners are numbered by 32 bits.
inline constexpr std::uint64_t kMostVertices = std::uint64_t{1} << 29;
inline constexpr std::uint64_t kMostCorners = 0x7fffffff;

// What the elements of some primitives come to in a PolygonMesh.
struct MeshSize {
    std::uint64_t vertices = 0, normals = 0, uvs = 0, colours = 0, corners = 0, faces = 0;
    std::uint64_t influences = 0, indices = 0; // of the primitive that has most
    void add(const PrimitiveData& primitive);
    void add(const MeshSize& other);
    std::uint64_t bytes() const; // of memory
    bool fits() const;           // the mesh's indices
};

class Flattener {
public:
    Flattener(const std::string& path, Warnings& warnings) : path_(path), warnings_(warnings) {}

    void reserve(const MeshSize& size);
    struct Where {
        DMat4 matrix{1};                  // the primitive's coordinates -> the file's
        const Palette* palette = nullptr; // of its skin, which then places it
    };
    struct Which {
        Index mesh = -1;
        std::size_t primitive = 0;
    };
    // uv: of its material. which: for messages.
    void add(const PrimitiveData& primitive, const Where& where, const UvUse& uv,
             std::int32_t material, const Which& which);
    geom::PolygonMesh take(); // colours of vertices made whole
    std::size_t skipped() const { return skipped_; }
    bool saw_colour_alpha() const { return colour_alpha_; } // COLOR_0 with an alpha below 1

private:
    void add_vertices(const PrimitiveData& primitive, const DMat4& matrix);
    void add_skinned(const PrimitiveData& primitive, const DMat4& matrix, const VertexSkin& skin);
    void add_uvs(const View& uvs, const UvUse& uv);
    void add_colours(const View& colours);
    bool read_indices(const PrimitiveData& primitive, const Which& which);
    void add_triangles(Mode mode, bool mirrored);
    void add_lines(Mode mode);
    void add_points();
    bool is_there(std::uint32_t vertex) const { return vertex < vertices_; }

    const std::string& path_;
    Warnings& warnings_;
    geom::PolygonMesh out_;
    std::size_t skipped_ = 0;
    bool colour_alpha_ = false;
    // Of the primitive that is added.
    std::vector<std::uint32_t> indices_;
    bool all_there_ = true; // no index is beyond the vertices
    std::uint32_t vertices_ = 0;
    std::int32_t material_ = -1, first_ = 0, first_uv_ = -1, first_normal_ = -1;
};

} // namespace scanout::io::gltf
