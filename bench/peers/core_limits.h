// How fast one core counts, reads and writes: what the floor of a load stands on.
#pragma once

#include "bench/peers/clock.h"

#include <cstddef>

#include <hwy/aligned_allocator.h>

namespace scanout::bench {

struct CoreLimits {
    double clock = 0;           // Hz
    double write = 0, read = 0; // bytes a second, in order, past the caches and of 64 MB
};

// Measures the core that the thread runs on, with the lanes that kernels use.
class CoreMeter {
public:
    CoreMeter();
    void measure();             // once; a thirtieth of a second
    CoreLimits typical() const; // medians of all

private:
    // What is written past the caches is not what is read into them.
    hwy::AlignedFreeUniquePtr<float[]> read_from_, written_;
    Times clock_, write_, read_;
};

} // namespace scanout::bench
