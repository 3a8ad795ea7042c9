// Polygons with vertices at infinity, on the screen: the sides of a shadow volume have no far end.
// Clipped in homogeneous coordinates, where a direction is a point with w = 0. Everitt and Kilgard
// 2002 (HARD-CASES 44).
#pragma once

#include "raster/count/stencil_count.h"
#include "raster/screen/screen.h"

#include <span>
#include <vector>

namespace scanout::raster {

// A point of view space (w 1), or a direction (w 0) in perspective. A parallel view cannot project
// a direction to its screen: pass a point far along it instead.
ClipVertex to_clip(const ScreenTransform& transform, const DVec4& view);

// Convex, at most 8 vertices. Appends its triangles to `out`. facing: triangles that wind clockwise
// on the screen get the weight, the others its negative, so that a closed surface weighs nothing;
// else all get the weight. id: kNoPrimitive, or the triangle of the scene that the polygon is.
enum class StencilSign : bool { same, facing };
void add_polygon(std::span<const ClipVertex> vertices, const ScreenTransform& transform,
                 float weight, StencilSign side, std::uint32_t id,
                 std::vector<StencilTriangle>& out);

} // namespace scanout::raster
