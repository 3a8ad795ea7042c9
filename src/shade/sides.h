// The side of its faces that a surface shows to the light: how triangle set-up and interpolation
// turn their normals.
#pragma once

#include "shade/stage.h"

#include <span>

namespace scanout::shade {

struct LitSides {
    Technique card;
    Sides reversed, others; // if some face winds the other way round its front, and if none
};

} // namespace scanout::shade
