// The materials that an OBJ file uses: its libraries found and read, its textures decoded.
#pragma once

#include "base/warnings.h"
#include "io/find_file.h"
#include "io/obj/obj.h"
#include "io/text_parts.h"
#include "scene/material.h"

#include <cstdint>
#include <string>
#include <vector>

namespace scanout::io {

struct Materials {
    std::vector<scene::Material> materials; // those used and defined, in the order of first use
    std::vector<scene::Texture> textures;   // each file once
    std::vector<std::int32_t> of_name;  // one an ObjFile::materials: index above, -1 not defined
    std::int32_t of_rest = -1;          // index above for what uses no material
    std::vector<std::string> libraries; // paths of those that were read
    std::uint64_t bytes = 0;            // of the libraries, and of the textures decoded
};

// Never fails: what is missing or damaged is a warning, and drawn plain. So is a texture that would
// bring them all over `texture_bytes`, as its header tells; smaller ones after it are still drawn.
Materials load_materials(const ObjFile& obj, const std::string& obj_path, Warnings& warnings,
                         const Reading& how = {});

// A material for each of these pictures, which is its diffuse map; of those that cannot be read the
// material is plain, with a warning.
Materials load_texture_materials(const std::vector<NameAtLine>& pictures,
                                 const std::string& model_path, Warnings& warnings,
                                 const Reading& how = {});

// The file names behind one mtllib: several with blanks between them, or one that holds blanks,
// quoted, with backslashes before its blanks, or bare. Names that exist in `folder` decide; what is
// left is split behind ".mtl".
std::vector<std::string> library_names(FileFinder& finder, const std::string& folder,
                                       const std::string& text);

} // namespace scanout::io
