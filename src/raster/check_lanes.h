// In test builds (SCANOUT_CHECK_LANES), no vertex and no depth may be NaN or infinite after its
// stage; the first that is ends the program. Elsewhere it is nothing.
#pragma once

#include "raster/screen.h"

#include <span>

namespace scanout::raster {

#ifdef SCANOUT_CHECK_LANES
void check_lanes(std::span<const ScreenVertex> vertices);
void check_lanes(std::span<const float> depths); // of a tile
#else
inline void check_lanes(std::span<const ScreenVertex>) {}
inline void check_lanes(std::span<const float>) {}
#endif

} // namespace scanout::raster
