// The oracle of depth and of perspective interpolation at a sample: exact integer areas of the
// snapped triangle as weights, sums and quotients in double-double (HARD-CASES R12).
#pragma once

#include "oracle/coverage.h"
#include "oracle/double_double.h"

#include <bit>

namespace scanout::oracle {

using Three = std::array<double, 3>;

// The areas opposite each corner as seen from a point (1/256 pixel), of one sign inside. Doubles
// hold them: they are integers below 2^53 within +-32768 pixels.
inline Three areas_at(const Corners& v, std::int64_t x, std::int64_t y) {
    return {static_cast<double>(cross(v[1], v[2], x, y)),
            static_cast<double>(cross(v[2], v[0], x, y)),
            static_cast<double>(cross(v[0], v[1], x, y))};
}

// What is linear on the screen (depth): f at the point.
inline Twofold linear_at(const Corners& v, const Three& f, std::int64_t x, std::int64_t y) {
    const Three e = areas_at(v, x, y);
    const Twofold top = Twofold(e[0]) * f[0] + Twofold(e[1]) * f[1] + Twofold(e[2]) * Twofold(f[2]);
    return top / Twofold(static_cast<double>(area(v)));
}

// What is linear in space (uv, colours, normals): sum(e f / w) / sum(e / w).
inline Twofold perspective_at(const Corners& v, const Three& f, const Three& w, std::int64_t x,
                              std::int64_t y) {
    const Three e = areas_at(v, x, y);
    Twofold top, bottom;
    for (std::size_t i = 0; i < 3; ++i) {
        const Twofold weight = Twofold(e[i]) / Twofold(w[i]);
        top = top + weight * f[i];
        bottom = bottom + weight;
    }
    return top / bottom;
}

// How f changes from one pixel to the next, right and down.
struct Slope {
    double x, y;
    double sum() const { return std::abs(x) + std::abs(y); }
};
inline Slope slope_of(const Corners& v, const Three& f) {
    const auto d = [](double a, double b) { return (a - b) / kUnitsPerPixel; };
    const double x1 = d(v[1].x, v[0].x), y1 = d(v[1].y, v[0].y), x2 = d(v[2].x, v[0].x),
                 y2 = d(v[2].y, v[0].y), f1 = f[1] - f[0], f2 = f[2] - f[0];
    const double whole = x1 * y2 - x2 * y1;
    return {(f1 * y2 - f2 * y1) / whole, (x1 * f2 - x2 * f1) / whole};
}

// |got - exact| / |exact|, in units of 2^-23.
inline double relative_error(float got, const Twofold& exact) {
    return std::abs(((Twofold(got) - exact) / exact).nearest()) * 0x1p23;
}

// How many floats lie from a to b; both positive.
inline std::int64_t floats_between(float a, float b) {
    return std::abs(std::int64_t{std::bit_cast<std::int32_t>(a)} - std::bit_cast<std::int32_t>(b));
}

} // namespace scanout::oracle
