// For each row of a visibility tile: where runs of one id end, which pixels are edge pixels, and
// which show a primitive.
#pragma once

#include "raster/tile/tile.h"

#include <array>
#include <cstdint>

namespace scanout::shade {

// Bit x is pixel x of the row, counted from the tile's corner.
struct RowBits {
    std::uint64_t ends;    // the next pixel's first sample shows another id
    std::uint64_t edge;    // an edge pixel: its samples show different ids
    std::uint64_t visible; // the first sample shows a primitive
};
// Writes rows [first, end) of the tile to out[row].
using TileRows = std::array<RowBits, raster::kTileSize>;
void find_runs(const raster::VisibilityTile& tile, int first, int end, TileRows& out);

// Interior pixels of a part of a tile, each filled by one primitive alone, as bits of the tile's
// rows.
struct InteriorPixels {
    std::array<std::uint64_t, raster::kTileSize> pixels, starts, ends; // ends: of runs
    int count, runs;
};
// The part: rows first to end, and the columns whose bits are set, which are adjacent.
void find_interior(const TileRows& rows, int first, int end, std::uint64_t columns,
                   InteriorPixels& out);

} // namespace scanout::shade
