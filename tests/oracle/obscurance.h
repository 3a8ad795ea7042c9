// Closed forms of obscurance (Zhukov, Iones and Kronin 1998): of light from everywhere, weighted by
// the cosine to the normal, the share that arrives, where what stands in the way at the distance d
// takes 1 - (d / radius)^2. Lengths are in radii. Nothing of the renderer.
#pragma once

#include <cmath>

namespace scanout::oracle {

// On a plane, beside an endless one at right angles to it, this far away. Directions by their
// cosine a to the way to the wall, which they meet at away / a: the integral over those that do of
// (1 - away^2 / a^2) 2 sqrt(1 - a^2) da, over pi.
inline double open_beside_wall(double away) {
    if (away >= 1) return 1;
    const double k = away, s = std::sqrt(1 - k * k), half_pi = std::asin(1.0),
                 rest = half_pi - std::asin(k);
    const double whole = (rest - k * s) / 2;           // of sqrt(1 - a^2)
    const double by_square = k > 0 ? s / k - rest : 0; // of sqrt(1 - a^2) / a^2
    return 1 - 2 * (whole - k * k * by_square) / (2 * half_pi);
}

// On the floor of a shaft, in the middle between round walls: by the angle to the normal.
inline double open_in_round_shaft(double away) {
    const double m = away * away;
    return m >= 1 ? 1 : m > 0 ? m - m * std::log(m) : 0;
}

// Likewise between the four walls of a square one: the wall of a direction is as far away as its
// azimuth says.
inline double open_in_square_shaft(double away) {
    constexpr int kSteps = 20000;
    const double quarter = std::asin(1.0) / 2;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double azimuth = quarter * (i + 0.5) / kSteps;
        sum += open_in_round_shaft(away / std::cos(azimuth));
    }
    return sum / kSteps;
}

} // namespace scanout::oracle
