// Wavefront OBJ: text -> polygons, lines and points in file units, double precision. Format:
// Wavefront, "Advanced Visualizer" manual, appendix B1. Free-form curves and surfaces are left out
// with a warning.
#pragma once

#include "base/result.h"
#include "base/warnings.h"
#include "geom/polygon_mesh.h"
#include "io/name_at_line.h"
#include "io/text_parts.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::io {

struct ObjFile {
    // Materials in polygons are indices into `materials`. Positions that could not be read are NaN,
    // so that the numbers of the others stay; every index is in range.
    geom::PolygonMesh polygons;
    std::vector<NameAtLine> materials; // of usemtl statements, in the order of first use
    std::vector<NameAtLine>
        libraries; // the words behind each mtllib, not yet split into file names
    // Where faces and positions stand; empty unless Reading::lines is set.
    std::vector<std::uint32_t> face_lines, position_lines;
    std::size_t skipped = 0; // statements that could not be used, free-form ones included
};

// `path` stands in messages. `progress` gets the share read, 0 to 1, every MB or so; false cancels.
// Faults of single lines are warnings (file:line); errors (Exit::unreadable) are a file without a
// usable vertex, a file beyond 2^31 vertices or 2^32 corners, and a cancelled read.
Result<ObjFile> read_obj(std::string_view file, const std::string& path, Warnings& warnings,
                         const std::function<bool(double)>& progress = nullptr,
                         const Reading& how = {});

} // namespace scanout::io
