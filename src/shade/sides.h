// The side of its faces that a surface shows to the light: how triangle set-up and interpolation
// turn their normals.
#pragma once

#include "shade/stage.h"

#include <span>

namespace scanout::shade {

struct LitSides {
    Technique card;
    Sides leaning, upright; // if some normal leans to the back of its face, and if none does
};

} // namespace scanout::shade
