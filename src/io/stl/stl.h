// STL, binary and ASCII (3D Systems 1989). Told apart by size and content: many binary files begin
// with the word "solid".
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

namespace scanout::io {

// STL has no normals worth keeping (one a facet, often zero) and no common vertices: smooth
// surfaces are told from edges by the angle between facets alone. 30 degrees keeps chamfers and the
// sides of a twelve-sided nut sharp up to rounding, and a cylinder of 13 facets or more round.
inline constexpr double kStlCreaseDegrees = 29;

struct StlResult {
    // One triangle a facet; vertices at the same place become one. Materials are indices into
    // `colours`.
    geom::PolygonMesh polygons;
    ColourMaterials colours; // of facets (stl_colours.h)
    std::size_t facets = 0;  // in `polygons`; the file has three vertices for each
    std::size_t skipped = 0; // facets that could not be used
};

// The facets of a binary file whose header and size agree, by its first 84 bytes; 0 for all others.
std::size_t stl_facets_told(std::string_view head, std::uint64_t size);

// Beyond doubt: binary with a size that agrees with its count, or ASCII. `head`: the file's first
// bytes.
bool is_stl(std::string_view head, std::uint64_t size);

// `path` stands in messages. Reads everything that can be shown, with a warning for the rest:
// facets that are not three finite points, a file that is cut short, a wrong count. Error
// (Exit::unreadable): not STL at all, no usable facet, or cancelled. `progress` gets the share of
// the file that will not be read again and returns false to cancel; it may be empty.
Result<StlResult> read_stl(std::string_view file, const std::string& path, Warnings& warnings,
                           const std::function<bool(double)>& progress, const Reading& how = {});

} // namespace scanout::io
