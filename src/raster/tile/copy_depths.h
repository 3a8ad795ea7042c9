// Copies a tile's depths to the rows of a picture that is not read again soon.
#pragma once

#include "raster/tile/tile.h"

#include <cstddef>

namespace scanout::raster {

inline constexpr int kFloatsOfLine = 16; // a cache line

// to: the pixel at the tile's corner; stride: floats from row to row. Writes whole cache lines with
// streaming stores, so that none is fetched first. Another thread may read them after a locked
// instruction of this thread, such as the end of a task of Jobs: x86 orders streaming stores with
// those (Intel SDM 3A, 9.2.2). A fence in every tile would wait until memory has all of the stores.
void copy_depths(const VisibilityTile& tile, float* to, std::size_t stride);

} // namespace scanout::raster
