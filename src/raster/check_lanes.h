// Debug checks of test builds (SCANOUT_CHECK_LANES): no vertex and no depth may be NaN or infinite
// after its stage. The first bad value ends the program with the stage's name. Values that a stage
// clamps are checked before the clamp. In other builds these functions do nothing.
#pragma once

#include "build_options.h"
#include "raster/clipped/clipped_triangle.h"
#include "raster/micro/small_triangles.h"
#include "raster/screen/primitive.h"
#include "raster/screen/screen.h"
#include "raster/tile/area.h"
#include "raster/tile/tile.h"

#include <span>

namespace scanout::raster {

#ifdef SCANOUT_CHECK_LANES
inline constexpr bool kCheckLanes = true;
void check_before_snap(double x, double y, std::size_t vertex); // pixels
inline void check_before_snap(const ClipVertex& v, std::size_t vertex) {
    check_before_snap(v.x / v.w, v.y / v.w, vertex);
}
void check_before_rounding(const ClipVertex& vertex);     // of a clipped triangle
void check_lanes(std::span<const ScreenVertex> vertices); // transformed; those on the screen
void check_lanes(const TriangleList& triangles);          // to be set up
void check_lanes(const BinnedList& triangles);            // likewise
void check_lanes(const ClippedTriangle& clipped);         // likewise
void check_lanes(const Segment& segment);
void check_lanes(const Point& point);
void check_lanes(const VisibilityTile& tile);              // drawn; the pixels of its area
void check_lanes(std::span<const AreaFragment> fragments); // of a pixel
#else
inline constexpr bool kCheckLanes = false;
inline void check_before_snap(double, double, std::size_t) {}
inline void check_before_snap(const ClipVertex&, std::size_t) {}
inline void check_before_rounding(const ClipVertex&) {}
inline void check_lanes(std::span<const ScreenVertex>) {}
inline void check_lanes(const TriangleList&) {}
inline void check_lanes(const BinnedList&) {}
inline void check_lanes(const ClippedTriangle&) {}
inline void check_lanes(const Segment&) {}
inline void check_lanes(const Point&) {}
inline void check_lanes(const VisibilityTile&) {}
inline void check_lanes(std::span<const AreaFragment>) {}
#endif

} // namespace scanout::raster
