// What a file shows that has vertices and nothing else.
#pragma once

#include "geom/framing.h"
#include "geom/polygon_mesh.h"

#include <cstddef>
#include <cstdint>

namespace scanout::io {

// Where there is no face, no line and no point every finite vertex is a point. True: so it was.
inline bool show_lone_vertices(geom::PolygonMesh& m) {
    if (m.faces() > 0 || !m.line_begin.empty() || !m.point_vertices.empty()) return false;
    for (std::size_t i = 0; i < m.positions.size(); ++i)
        if (geom::is_finite(m.positions[i]))
            m.point_vertices.push_back(static_cast<std::uint32_t>(i));
    m.point_material.assign(m.point_vertices.size(), -1);
    return true;
}

} // namespace scanout::io
