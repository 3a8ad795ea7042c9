// The side of its faces that a surface shows to the light: how triangle set-up and interpolation
// turn their normals.
#pragma once

#include "shade/stage.h"

#include <span>

namespace scanout::shade {

struct LitSides {
    Technique card;
    Sides reversed, others; // if all normals of some face point to its back, and if of none
};

} // namespace scanout::shade
