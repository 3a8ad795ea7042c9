// PLY, the Stanford polygon format (Turk 1994): ASCII and both binary forms, properties in any
// order and of any type, lists, triangle strips, edges, points; colours, normals and texture
// coordinates of vertices, texture coordinates and colours of faces; MeshLab's texture comments.
#pragma once

#include "base/result.h"
#include "base/warnings.h"
#include "geom/polygon_mesh.h"
#include "io/colour_materials.h"
#include "io/name_at_line.h"
#include "io/text_parts.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::io {

struct PlyFile {
    // Face materials are indices into `textures`, or textures.size() plus an index into
    // `face_colours`.
    geom::PolygonMesh polygons;
    std::vector<NameAtLine> textures;
    ColourMaterials face_colours;
    std::size_t skipped = 0; // rows that could not be used
    // Where faces and positions of a text stand; empty unless Reading::lines is set.
    std::vector<std::uint32_t> face_lines, position_lines;
};

// `path` stands in messages. Reads everything that can be shown, with a warning for the rest: rows
// with a fault, indices out of range, a body that ends early. Where there is neither face nor edge,
// all vertices are points. Errors (Exit::unreadable): a header that makes the body unreadable, no
// usable vertex, too many, or cancelled. `progress` gets the fraction of the file that will not be
// read again and returns false to cancel; it may be empty.
Result<PlyFile> read_ply(std::string_view file, const std::string& path, Warnings& warnings,
                         const std::function<bool(double)>& progress, const Reading& how = {});

} // namespace scanout::io
