// Lines and points that a frame draws beside those of its mesh: their ids come after the mesh's
// own.
#pragma once

#include "geom/mesh.h"
#include "math/vec.h"

#include <cstdint>
#include <vector>

namespace scanout::shade {

struct AddedLines {
    std::uint32_t first_id = 0;
    // Its line_material and point_material number the colours.
    const geom::Mesh* mesh = nullptr;
    std::vector<Vec3> colours; // linear

    const Vec3& colour(std::uint32_t id) const {
        const std::size_t line = id - first_id, lines = mesh->lines();
        return colours[static_cast<std::size_t>(line < lines ? mesh->line_material[line]
                                                             : mesh->point_material[line - lines])];
    }
};

} // namespace scanout::shade
