// What the tests of this module share: snapped triangles from corners, a view without a camera, and
// the oracle's names.
#pragma once

#include "oracle/coverage.h"
#include "raster/geometry.h"
#include "support/random.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::raster::test {

using oracle::Corner;
using oracle::Corners;
using oracle::ExactTriangle;
using oracle::Int128;
using scanout::test::Random;

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
    return oracle::area(v) != 0;
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

// A measured value, in the report of the test (--gtest_output=xml) and on the screen when it fails.
inline void record(const std::string& name, double value) {
    testing::Test::RecordProperty(name, testing::PrintToString(value));
}

} // namespace scanout::raster::test
