// Where runs of one id end in a row of a visibility tile, which are edge pixels, and which show
// something.
#pragma once

#include "raster/tile/tile.h"

#include <array>
#include <cstdint>

namespace scanout::shade {

// Bit x is pixel x of the row, counted from the tile's corner.
struct RowBits {
    std::uint64_t ends;    // the next pixel's first sample shows another id
    std::uint64_t edge;    // an edge pixel: not all samples show the same
    std::uint64_t visible; // the first sample shows something
};
// Of rows [first, end) of the tile: out[row].
using TileRows = std::array<RowBits, raster::kTileSize>;
void find_runs(const raster::VisibilityTile& tile, int first, int end, TileRows& out);

// Interior pixels of a part of a tile: those that one primitive fills alone, as bits of the tile's
// rows.
struct InteriorPixels {
    std::array<std::uint64_t, raster::kTileSize> pixels, starts, ends; // ends: of runs
    int count, runs;
};
// Of rows first to end, and the columns whose bits are set, which stand side by side.
void find_interior(const TileRows& rows, int first, int end, std::uint64_t columns,
                   InteriorPixels& out);

} // namespace scanout::shade
