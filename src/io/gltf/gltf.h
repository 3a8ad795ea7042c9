// glTF 2.0 (Khronos 2021), as JSON with files beside it or as GLB: the default scene, flattened.
#pragma once

#include "base/result.h"
#include "base/warnings.h"
#include "geom/polygon_mesh.h"
#include "io/text_parts.h"
#include "scene/material.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::io {

struct GltfFile {
    // In the file's units: each node's mesh once for each of its places. Materials are indices of
    // `materials`, -1 where the file gives none.
    geom::PolygonMesh polygons;
    std::optional<Reach> reach;          // of an animation that was asked for
    std::vector<std::string> animations; // one line each, for reports
    std::vector<scene::Material> materials;
    std::vector<scene::Texture> textures;
    std::vector<std::string> cameras; // one line each, for reports
    std::size_t skipped = 0;          // primitives, faces, lines and points that could not be used
    std::uint64_t bytes = 0;          // of the files beside it, and of the decoded textures
    double parse_ms = 0, material_ms = 0;
};

bool is_gltf(std::string_view file); // by its first bytes

// As read_ply() (ply.h). What cannot be shown is left out with a warning; an error names the node,
// accessor or buffer and its bytes.
Result<GltfFile> read_gltf(std::string_view file, const std::string& path, Warnings& warnings,
                           const std::function<bool(double)>& progress, const Reading& how = {});

} // namespace scanout::io
