// Materials of a glTF file -> the scene's, with their textures. Roughness and metalness go where
// MTL's Pr and Pm go, so reflection is what those have (shade/reflection/ggx.cpp): F0 is 4 %, or
// the colour of a metal; scene::Material::roughness and metalness hold the file's own numbers.
#pragma once

#include "base/warnings.h"
#include "io/gltf/buffers.h"
#include "io/gltf/document.h"
#include "scene/material.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scanout::io::gltf {

// The coordinates that a material's faces get: a set, moved as its first map says.
struct UvUse {
    int set = 0;
    DVec2 x{1, 0}, y{0, 1}, offset{0}; // columns of the matrix
    DVec2 apply(const DVec2& uv) const { return (x * uv.x + y * uv.y) + offset; }
    friend bool operator==(const UvUse&, const UvUse&) = default;
};

struct Looks {
    std::vector<scene::Material> materials; // of those that are used
    std::vector<std::int32_t> of;           // index above of each of the document's, -1 unused
    std::vector<UvUse> uv;                  // of each of the document's
    std::vector<scene::Texture> textures;
    std::uint64_t bytes = 0; // of the decoded textures
};

// Never fails: a texture that cannot be read is a warning, and drawn plain. used: by material.
Looks read_looks(const Document& document, const std::vector<bool>& used, Buffers& buffers,
                 const std::string& path, Warnings& warnings, const Reading& how, Budget& budget);

} // namespace scanout::io::gltf
