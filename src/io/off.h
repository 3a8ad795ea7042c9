// OFF, the Object File Format of Geomview (Phillips et al. 1993): vertices and polygons as text,
// with colours, normals and texture coordinates of vertices if the keyword announces them, and
// colours of faces.
#pragma once

#include "base/result.h"
#include "base/warnings.h"
#include "geom/polygon_mesh.h"
#include "io/colour_materials.h"
#include "io/text_parts.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::io {

struct OffFile {
    geom::PolygonMesh polygons; // face materials are numbers of `face_colours`
    ColourMaterials face_colours;
    std::size_t skipped = 0; // vertices and faces that could not be used
    // Where faces and positions stand; empty unless Reading::lines is set.
    std::vector<std::uint32_t> face_lines, position_lines;
};

bool is_off(std::string_view file); // begins with one of the format's keywords

// As read_ply() (ply.h). Four-dimensional and binary files are refused.
Result<OffFile> read_off(std::string_view file, const std::string& path, Warnings& warnings,
                         const std::function<bool(double)>& progress, const Reading& how = {});

} // namespace scanout::io
