// sRGB by the formula of IEC 1999, in double, and nothing of ours.
#pragma once

#include <algorithm>
#include <cmath>

namespace scanout::test {

// Linear light of a code.
inline double decoded(int code) {
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
// In codes, not rounded; light beyond [0, 1] is cut off.
inline double encoded(double linear) {
    const double x = std::clamp(linear, 0.0, 1.0);
    return 255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055);
}

} // namespace scanout::test
