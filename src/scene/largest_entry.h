#pragma once

#include "math/vec.h"

#include <algorithm>
#include <cmath>

namespace scanout::scene {

// The greatest size of an entry of a matrix.
inline double largest_entry(const DMat3& m) {
    double largest = 0;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            largest = std::max(largest, std::abs(m[c][r]));
    return largest;
}

} // namespace scanout::scene
