// From a tile's visibility buffer to blocks of items and on to the picture's pixels: visible pixels
// are collected across triangles (PixelCollector), 128 a block, one material a block
// (BlockBuilder), and their light is stored or summed (PixelSink). Each triangle is shaded once a
// pixel, at the centre if it covers it, else at its first visible sample.
#pragma once

#include "raster/tile/area.h"
#include "raster/tile/tile.h"
#include "shade/gather/block_builder.h"
#include "shade/gather/gather_input.h"
#include "shade/gather/pixel_collector.h"
#include "shade/gather/pixel_sink.h"

#include <cstdint>

namespace scanout::shade {

// One a worker: the block and the lists live from tile to tile.
class Gatherer {
public:
    // For the tile that is shaded next; null: nothing was counted.
    void set_shadow(const TileShadow* shadow) { builder_.set_shadow(shadow); }
    // Stores every pixel of the tile that shows a primitive, and no other. With blended fragments:
    // of their region of the tile. Returns how many items were shaded.
    std::uint64_t shade(const raster::VisibilityTile& tile, const GatherInput& input,
                        PixelSink& sink, const BlendedPixels* blended = nullptr);
    // The same by areas, where all is opaque.
    std::uint64_t shade(raster::AreaTile& tile, const GatherInput& input, PixelSink& sink);

private:
    std::uint64_t shade_collected(const GatherInput& input, const raster::VisibilityTile* visible,
                                  const BlendedPixels* blended, PixelSink& sink);
    PixelCollector collector_;
    BlockBuilder builder_;
};

} // namespace scanout::shade
