// Copies a tile's depths to the rows of a picture that is not read again soon.
#pragma once

#include "raster/tile/tile.h"

#include <cstddef>

namespace scanout::raster {

inline constexpr int kFloatsOfLine = 16; // a cache line

// to: of the pixel at the tile's corner; stride: floats from row to row. Whole cache lines are
// written with streaming stores, so that none is fetched before. Another thread may read them when
// a locked instruction of this one has let it, as the end of a task of Jobs is: x86 orders
// streaming stores with those (Intel SDM 3A, 9.2.2). A fence a tile would wait until memory has all
// of them.
void copy_depths(const VisibilityTile& tile, float* to, std::size_t stride);

} // namespace scanout::raster
