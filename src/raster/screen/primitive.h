// The primitives that tiles draw: triangles, line segments and points in snapped screen
// coordinates. All primitives of the scene have ids in one numbering: triangles first, then
// segments, then points, each in the order of the mesh; at equal depth the lower id is visible.
#pragma once

#include "image/image.h"
#include "raster/screen/sample_pattern.h"
#include "raster/screen/screen.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>

namespace scanout::raster {

inline constexpr std::uint32_t kNoPrimitive = 0xffffffff;

// Vertices in canonical order (lowest y, then x, first), so that no bit depends on the order in
// which a file names them; edges then have their interior on the positive side.
struct Triangle {
    std::array<std::int32_t, 3> x, y; // 1/256 pixel
    std::array<double, 3> depth;
    std::uint32_t id;
    bool flipped; // the canonical order winds the other way: edge functions change sign
};

// Vertices on the screen in the order of the mesh, perhaps without area.
struct SnappedTriangle {
    std::array<ScreenVertex, 3> vertex;
    std::uint32_t id;
};

struct Segment {
    std::array<std::int32_t, 2> x, y;
    std::array<double, 2> depth;
    std::uint32_t id;
    int width = 1; // pixels, across its longer axis
};

struct Point {
    std::int32_t x, y;
    double depth;
    std::uint32_t id;
    int size = 1; // pixels
};

// The three edge functions E_i = a_i x + b_i y + c_i (x, y in 1/256 pixel), positive inside, exact
// in int64 (|E| < 2^50 within the guard band); E_i is opposite vertex i and E_0 + E_1 + E_2 = area,
// twice the triangle's area. Pineda 1988.
struct Edges {
    std::array<std::int64_t, 3> a, b, c;
    std::array<std::int64_t, 3> bias; // top-left rule: inside iff E + bias >= 0
    std::int64_t area;

    std::int64_t at(int i, std::int64_t x, std::int64_t y) const {
        const auto k = static_cast<std::size_t>(i);
        return a[k] * x + b[k] * y + c[k];
    }
};
Edges edges_of(const Triangle& triangle);

// Twice the signed area of three snapped vertices; > 0 is clockwise on the screen (y runs down).
std::int64_t signed_area(const std::array<std::int32_t, 3>& x,
                         const std::array<std::int32_t, 3>& y);

// The canonical order of three distinct points: a permutation of {0, 1, 2}, and whether it is odd.
struct CanonicalOrder {
    std::array<std::uint8_t, 3> vertex;
    bool odd;
};
CanonicalOrder canonical_order(const std::array<std::int32_t, 3>& x,
                               const std::array<std::int32_t, 3>& y);

// A triangle from three snapped vertices in any order; nothing when it snapped to zero area and so
// covers no sample (HARD-CASES 4, R6). clockwise: on the screen, in the order given.
struct SetUp {
    Triangle triangle;
    CanonicalOrder order;
    bool clockwise;
};
std::optional<SetUp> set_up(const std::array<ScreenVertex, 3>& vertex, std::uint32_t id);

// A segment is drawn pixel by pixel along its longer axis, x if both are as long.
inline bool is_along_x(const Segment& s) {
    return std::abs(std::int64_t{s.x[1]} - s.x[0]) >= std::abs(std::int64_t{s.y[1]} - s.y[0]);
}

// The pixels that may hold a sample of the primitive, within a picture of the given size; empty
// when no sample can lie in the triangle's box.
image::Rect pixel_bounds(const Triangle& triangle, int width, int height,
                         const SampleExtent& extent = {});
image::Rect pixel_bounds(const Segment& segment, int width, int height);
image::Rect pixel_bounds(const Point& point, int width, int height);

} // namespace scanout::raster
