// The least that one core could take for a load, by a model: the picture written once past the
// caches, vertices and indices read once, and the cycles of sixteen lanes for what is done to each
// vertex, triangle and pixel. How fast this core writes, reads and counts is measured.
#pragma once

#include "bench/peers/core_limits.h"
#include "bench/peers/load.h"

#include <cstddef>

namespace scanout::bench {

struct Work {
    std::size_t vertices = 0, triangles = 0;
    double drawn = 0;     // triangles that are left after culling
    double fragments = 0; // that pass the depth test
    double pixels = 0;    // of the picture
};
// Milliseconds; 0 where the model says nothing: of more than one sample.
double floor_of(const Load& load, const Work& work, const CoreLimits& core);

} // namespace scanout::bench
