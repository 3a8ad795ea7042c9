// Triangles whose place on the screen is known exactly: positions in view space such that pixel
// times w comes out without rounding, so that a test knows the snapped corners without asking the
// renderer.
#pragma once

#include "math/vec.h"
#include "oracle/coverage.h"

#include <cmath>

namespace scanout::oracle {

// The largest number of few bits (5) that is not above w: products with 19 bits fit a float.
inline double few_bits(double w) {
    const double step = std::exp2(std::floor(std::log2(w)) - 4);
    return std::floor(w / step) * step;
}

// For a view that spans 2 units across and 2 down at distance 1, and sides that are powers of two.
// corner: 1/256 pixel, within the picture (at most 2^20 of them); w of few bits.
inline Vec3 placed(const Corner& corner, double w, int width, int height) {
    const double x = width / 2.0, y = height / 2.0;
    return {static_cast<float>((corner.x / 256.0 - x) / x * w),
            static_cast<float>((y - corner.y / 256.0) / y * w), static_cast<float>(-w)};
}

} // namespace scanout::oracle
