// The data that map/bump.cpp keeps of a block while it reads heights beside each item.
#pragma once

#include "shade/stage.h"

namespace scanout::shade::map {

struct BumpNeighbours {
    alignas(64) float u[kPaddedBlock], v[kPaddedBlock]; // of the items themselves
    alignas(64) float step[kPaddedBlock];               // distance to the neighbours, in texels
    alignas(64) float height[4][kPaddedBlock];          // at u + step, u - step, v + step, v - step
    float texel_u = 0, texel_v = 0;                     // size of a texel
};

} // namespace scanout::shade::map
