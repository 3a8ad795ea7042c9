// The gatherer's first part: what a tile shows in its interior pixels, and in its edge pixels,
// those in which several primitives are visible, or one and the background.
#pragma once

#include "raster/tile/area.h"
#include "raster/tile/tile.h"
#include "shade/gather/gather_input.h"
#include "shade/gather/gather_types.h"
#include "shade/gather/tile_pixels.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::shade {

struct BlendedPixels;

class PixelCollector {
public:
    // With blended fragments: of their region of the tile. with_samples: of each edge fragment, the
    // samples at which it shows.
    void collect(const raster::VisibilityTile& tile, const GatherInput& input,
                 const BlendedPixels* blended, bool with_samples);
    // The same by areas, where all is opaque.
    void collect(raster::AreaTile& tile, const GatherInput& input);

    const image::Rect& area() const { return area_; } // of the tile
    int samples() const { return samples_; }          // of a pixel of it
    TilePixels& interior_pixels() { return interior_pixels_; }
    // The ids of interior_pixels() are spatial indices (geom/clusters.h).
    bool has_spatial_indices() const { return spatial_indices_; }
    EdgePixels& edge_pixels() { return edge_pixels_; }
    // What edge pixels show. Empty where they are bits of rows().
    std::vector<EdgeFragment>& fragments() { return fragments_; }
    // Edge pixels as bits of the tile's rows, not fragments of a list: all primitives have one key,
    // and every triangle can be set up in the block. Buys 57 M of 319 M instructions of the bunny
    // with 4 samples.
    bool by_rows() const { return by_rows_; }
    using Rows = std::array<std::uint64_t, raster::kTileSize>;
    const Rows& rows() const { return edge_bits_; }

private:
    void begin(const image::Rect& area, int samples);
    bool collect_small_triangles(const raster::VisibilityTile& tile, const GatherInput& input);
    void collect_row(int row, std::uint64_t edges);
    void collect_fragments(const raster::VisibilityTile& tile, const GatherInput& input, int row,
                           std::uint64_t edges, bool with_samples);
    void collect_blended(const raster::VisibilityTile& tile, const GatherInput& input,
                         const BlendedPixels& blended, int pixel);
    void collect_layers(const raster::VisibilityTile& tile, const GatherInput& input,
                        const BlendedPixels& blended, int pixel);

    image::Rect area_;
    int samples_ = 1;
    TilePixels interior_pixels_;
    bool spatial_indices_ = false;
    bool all_unclipped_ = false; // every triangle can be set up in the block
    bool by_rows_ = false;
    Rows edge_bits_{};
    EdgePixels edge_pixels_;
    std::vector<EdgeFragment> fragments_;
    struct VisibleSurface { // of one pixel
        float depth;        // at the first sample that shows it
        EdgeFragment fragment;
    };
    std::vector<VisibleSurface> surfaces_;
};

} // namespace scanout::shade
