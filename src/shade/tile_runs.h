// Where runs of one id end in a row of a visibility tile, and which pixels several ids share.
#pragma once

#include "raster/tile.h"

#include <cstdint>

namespace scanout::shade {

// Bit x is pixel x of the row, counted from the tile's corner.
struct RowBits {
    std::uint64_t ends;   // the next pixel's first sample shows another id
    std::uint64_t shared; // not all samples show the same
};
RowBits row_bits(const raster::VisibilityTile& tile, int row);

} // namespace scanout::shade
