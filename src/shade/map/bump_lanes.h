// What map/bump.cpp keeps of a block while it reads heights beside each lane.
#pragma once

#include "shade/stage.h"

namespace scanout::shade::map {

struct BumpLanes {
    alignas(64) float u[kPaddedBlock], v[kPaddedBlock]; // of the lanes themselves
    alignas(64) float reach[kPaddedBlock];              // how far the neighbours lie, in texels
    alignas(64) float height[4][kPaddedBlock]; // at u + reach, u - reach, v + reach, v - reach
    float texel_u = 0, texel_v = 0;            // size of a texel
};

} // namespace scanout::shade::map
