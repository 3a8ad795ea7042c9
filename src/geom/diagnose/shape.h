// The shape of triangles: how far from having an area.
#pragma once

#include "geom/diagnose/surface.h"

#include <array>
#include <cstdint>

namespace scanout::geom {

// Longest edge divided by height, 2 / sqrt(3) at least; infinite without an area.
double sliverness(const DVec3& a, const DVec3& b, const DVec3& c);

// Above it the height is below the rounding of a file's coordinates.
inline constexpr double kNoArea = 0x1p40;
// Two corners are one place, or the height is below 2^-40 of the longest edge.
bool has_no_area(const Surface& surface, const std::array<std::uint32_t, 3>& places);

} // namespace scanout::geom
