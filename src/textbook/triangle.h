// What flows through a textbook renderer: vertices in homogeneous coordinates with the values that
// go along, then the corners of triangles on the screen.
#pragma once

#include "math/vec.h"
#include "textbook/fill/fill.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace scanout::textbook {

// The values of a vertex that are interpolated ("varyings"): all alike to every method.
inline constexpr std::size_t kPlace = 0, kNormal = 3, kUv = 6, kColour = 8, kValues = 11;
using Values = std::array<double, kValues>;

inline Values mix(const Values& a, const Values& b, double t) {
    Values out;
    for (std::size_t i = 0; i < kValues; ++i)
        out[i] = a[i] + (b[i] - a[i]) * t;
    return out;
}

struct Vertex {
    DVec4 clip{0}; // homogeneous, before the division
    Values values{};
};
inline Vertex mix(const Vertex& a, const Vertex& b, double t) {
    return {a.clip + (b.clip - a.clip) * t, mix(a.values, b.values, t)};
}

struct Corner {
    double x = 0, y = 0; // pixels, y down, pixel centres at half-integers
    double z = 0;        // depth after the division
    double w = 1;
    Values values{};
};

// Places and depths are linear on the screen, values are not: value/w and 1/w are.
inline Corner mix(const Corner& a, const Corner& b, double t) {
    const auto linear = [t](double from, double to) { return from + (to - from) * t; };
    Corner out{
        linear(a.x, b.x), linear(a.y, b.y), linear(a.z, b.z), 1 / linear(1 / a.w, 1 / b.w), {}};
    for (std::size_t i = 0; i < kValues; ++i)
        out.values[i] = linear(a.values[i] / a.w, b.values[i] / b.w) * out.w;
    return out;
}

struct Triangle {
    std::array<Corner, 3> corner;
    std::uint32_t source = 0; // the mesh's triangle
    // From the plane of the eye. In perspective that is w; in an orthographic view w is 1.
    double distance_of_middle() const {
        constexpr std::size_t z = kPlace + 2;
        return -(corner[0].values[z] + corner[1].values[z] + corner[2].values[z]) / 3;
    }
};

// An edge of the mesh on the screen, where a pixel is a point with whole coordinates.
struct Wire {
    DVec2 from{0}, to{0};
    std::uint32_t source = 0; // a triangle of the mesh that it belongs to
};

// The corners where a pixel is a point with whole coordinates.
inline Points points_of(const Triangle& t) {
    const auto point = [](const Corner& c) { return DVec2(c.x - 0.5, c.y - 0.5); };
    return {point(t.corner[0]), point(t.corner[1]), point(t.corner[2])};
}

// Barycentric coordinates: the areas of the triangles that a point makes with the edges
// [Compendium 3.2.2], [SoftwareGraphics]. They add up to 1.
inline std::array<double, 3> barycentric(const Points& p, double x, double y) {
    const double area = twice_area(p[0], p[1], p[2]);
    const double b = twice_area(p[2], p[0], DVec2(x, y)) / area,
                 c = twice_area(p[0], p[1], DVec2(x, y)) / area;
    return {1 - b - c, b, c};
}

} // namespace scanout::textbook
