// What the pixels of a row show that several primitives share, or that the background shows
// through: found for a register of pixels at once, sample by sample.
#pragma once

#include "raster/tile.h"

#include <cstdint>

namespace scanout::shade {

struct SharedRow {
    static constexpr int kSamples = 16; // at most
    // Bit x: what pixel x shows at this sample, a primitive, no sample before it shows.
    std::uint64_t first[kSamples];
    // Of those: of the pixel's samples, how many show the same, as its share.
    alignas(64) float share[kSamples][raster::kTileSize];
    alignas(64) float through[raster::kTileSize]; // the background's
};
// Of a row counted from the tile's corner. Only pixels whose bits are set in `shared` are looked
// at, and perhaps their neighbours.
void find_shares(const raster::VisibilityTile& tile, int row, std::uint64_t shared, SharedRow& out);

} // namespace scanout::shade
