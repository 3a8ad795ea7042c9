// How fast one core counts, reads and writes: what the floor of a load stands on.
#pragma once

namespace scanout::bench {

struct CoreLimits {
    double clock = 0;           // Hz
    double write = 0, read = 0; // bytes a second, in order, past the caches and of 64 MB
};
// Of the core that the thread runs on, with the lanes that kernels use; a tenth of a second.
CoreLimits measure_core();

} // namespace scanout::bench
