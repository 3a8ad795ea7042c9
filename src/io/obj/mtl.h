// Wavefront MTL: text -> materials. Format: Wavefront 1995, with the common additions (Ke, norm,
// the PBR values). Files that mtllib names may be anything at all, so no message quotes their
// contents.
#pragma once

#include "base/warnings.h"
#include "scene/material.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::io {

struct MtlMaterial {
    scene::Material material; // maps have their path as the file names it, no texture yet
    std::size_t line = 0;     // of its newmtl
    // Ks, Ke, Pr or Pm is missing, but its map is given: the map alone gives colours or numbers.
    bool specular_by_map = false, emission_by_map = false;
    bool roughness_by_map = false, metalness_by_map = false;
    // Requested features that the renderer does not draw yet, in MTL's words.
    std::vector<std::string_view> not_drawn;
};

// `path` stands in messages (file:line). Never fails: values that cannot be read keep their
// defaults.
std::vector<MtlMaterial> read_mtl(std::string_view file, const std::string& path,
                                  Warnings& warnings);

} // namespace scanout::io
