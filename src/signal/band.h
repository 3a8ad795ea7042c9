// A band of frequencies, as fractions of Nyquist's.
#pragma once

#include <limits>

namespace scanout::signal {

// Both ends included.
struct Band {
    double low = 0, high = std::numeric_limits<double>::infinity();
};

} // namespace scanout::signal
