// How two triangles of a surface lie to each other.
#pragma once

#include "math/vec.h"

#include <array>
#include <optional>

namespace scanout::geom {

using Corners = std::array<DVec3, 3>;

// Each has corners on both sides of the other's plane, farther from it than `touch`, and an edge of
// one meets the other, its border included. By exact predicates: triangles that only touch do not
// cross, nor do those that share an edge.
bool triangles_cross(const Corners& a, const Corners& b, double touch);

// Do they overlap, within `gap` of one plane? Returns how far apart they are there. Overlaps
// narrower than kOverlap of the smaller triangle's longest edge are none: rounded coordinates of
// neighbours make such.
inline constexpr double kOverlap = 0.01;
std::optional<double> overlap_gap(const Corners& a, const Corners& b, double gap);

} // namespace scanout::geom
