// Edges of the model's faces, drawn over the shading (axis `edges`). What an edge is, and which
// ones are features, stands in geom/edge_lines.h.
#pragma once

#include "base/technique.h"

#include <cstdint>

namespace scanout::frame {

struct Edges {
    enum class Of : std::uint8_t { nothing, faces, features };
    Technique card;
    Of of = Of::nothing;
};

} // namespace scanout::frame
