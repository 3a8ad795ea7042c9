// Which side of its faces a surface shows to the light: what the set-up of triangles and the
// interpolation do with their normals.
#pragma once

#include "shade/stage.h"

#include <span>

namespace scanout::shade {

struct LitSides {
    Technique card;
    Sides leaning, upright; // where some normal leans to the back of its face, and where none does
};

} // namespace scanout::shade
