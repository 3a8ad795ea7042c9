// The primitives visible in the edge pixels of a row: pixels in which several primitives are
// visible, or one and the background. Found for a register of pixels at once, sample by sample.
#pragma once

#include "raster/tile/tile.h"

#include <cstdint>

namespace scanout::shade {

struct EdgeRow {
    static constexpr int kSamples = 16; // at most
    // Bit x: pixel x shows a primitive at this sample that it shows at no earlier sample.
    std::uint64_t first[kSamples];
    // The share of the pixel's samples that show the primitive of `first`.
    alignas(64) float coverage[kSamples][raster::kTileSize];
    alignas(64) float transmittance[raster::kTileSize]; // the background's
};
// row: counted from the tile's corner. Only pixels whose bits are set in `edges` are read, and
// perhaps their neighbours.
void find_edge_row(const raster::VisibilityTile& tile, int row, std::uint64_t edges, EdgeRow& out);

} // namespace scanout::shade
