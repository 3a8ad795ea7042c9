// What the edge pixels of a row show: those in which several primitives are visible, or one and the
// background. Found for a register of pixels at once, sample by sample.
#pragma once

#include "raster/tile/tile.h"

#include <cstdint>

namespace scanout::shade {

struct EdgeRow {
    static constexpr int kSamples = 16; // at most
    // Bit x: what pixel x shows at this sample, a primitive, no sample before it shows.
    std::uint64_t first[kSamples];
    // Of those: the part of the pixel's samples that shows the same.
    alignas(64) float coverage[kSamples][raster::kTileSize];
    alignas(64) float transmittance[raster::kTileSize]; // the background's
};
// Of a row counted from the tile's corner. Only pixels whose bits are set in `edges` are looked at,
// and perhaps their neighbours.
void find_edge_row(const raster::VisibilityTile& tile, int row, std::uint64_t edges, EdgeRow& out);

} // namespace scanout::shade
