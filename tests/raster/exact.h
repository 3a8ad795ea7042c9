// The oracle of coverage: exact integers of 128 bits, and no tie rule at all. A sample that the
// top-left rule puts inside is one that lies inside after it has moved by an infinitely small step
// to the right and a still smaller one down, so that is what is computed: coordinates are scaled by
// 2^60 and the sample moved by (2^30, 1), which no edge that misses the sample can notice (its
// function is at least 2^60 there; the step changes it by less than 2^56).
#pragma once

#include "raster/geometry.h"
#include "support/random.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace scanout::raster::test {

using scanout::test::Random;
__extension__ typedef __int128 Int128;

struct Corner {
    std::int32_t x, y; // 1/256 pixel
};
using Corners = std::array<Corner, 3>;

class ExactTriangle {
public:
    explicit ExactTriangle(const Corners& v) {
        const Int128 area = cross(v[0], v[1], v[2].x, v[2].y);
        empty_ = area == 0;
        for (std::size_t i = 0; i < 3; ++i) {
            from_[i] = v[i];
            to_[i] = v[(i + 1) % 3];
            if (area < 0) std::swap(from_[i], to_[i]);
        }
    }
    bool covers(std::int32_t x, std::int32_t y) const { return inside(at(x, y)); }

    // The scaled edge functions, and what they change by from one pixel to the next.
    std::array<Int128, 3> at(std::int32_t x, std::int32_t y) const {
        std::array<Int128, 3> e;
        for (std::size_t i = 0; i < 3; ++i) {
            const Int128 dx = Int128{to_[i].x} - from_[i].x, dy = Int128{to_[i].y} - from_[i].y;
            const Int128 px = (Int128{x} - from_[i].x) * kScale + (Int128{1} << 30);
            const Int128 py = (Int128{y} - from_[i].y) * kScale + 1;
            e[i] = dx * py - dy * px;
        }
        return e;
    }
    void step_right(std::array<Int128, 3>& e) const {
        for (std::size_t i = 0; i < 3; ++i)
            e[i] -= (Int128{to_[i].y} - from_[i].y) * kScale * kSubpixel;
    }
    bool inside(const std::array<Int128, 3>& e) const {
        return !empty_ && e[0] > 0 && e[1] > 0 && e[2] > 0;
    }

private:
    static constexpr Int128 kScale = Int128{1} << 60;
    static Int128 cross(const Corner& a, const Corner& b, std::int64_t x, std::int64_t y) {
        return (Int128{b.x} - a.x) * (Int128{y} - a.y) - (Int128{b.y} - a.y) * (Int128{x} - a.x);
    }
    std::array<Corner, 3> from_, to_;
    bool empty_;
};

// The triangle that the geometry stage makes of three snapped vertices; area 0 when it drops it.
inline Triangle set_up(const Corners& v, std::uint32_t id,
                       const std::array<double, 3>& depth = {0.5, 0.5, 0.5}) {
    std::array<ScreenVertex, 3> vertex;
    for (std::size_t i = 0; i < 3; ++i) {
        vertex[i].x = v[i].x;
        vertex[i].y = v[i].y;
        vertex[i].depth = depth[i];
    }
    return raster::set_up(vertex, id).value_or(SetUp{}).triangle;
}
inline bool has_area(const Corners& v) {
    return signed_area({v[0].x, v[1].x, v[2].x}, {v[0].y, v[1].y, v[2].y}) != 0;
}

// A view without a camera: mesh x, y are pixels of a picture of this size (y up from the bottom),
// z is depth. For tests that place vertices themselves.
inline scene::View pixel_view(int width, int height) {
    scene::View view;
    view.projection = scene::Projection::orthographic;
    view.half_width = width / 2.0;
    view.half_height = height / 2.0;
    view.translation = {-width / 2.0, -height / 2.0, 0};
    return view;
}

} // namespace scanout::raster::test
