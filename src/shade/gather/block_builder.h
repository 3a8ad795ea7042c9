// The gatherer's second part: fills blocks with items of one key, and runs the stages over those
// that are full.
#pragma once

#include "shade/gather/edge_row.h"
#include "shade/gather/gather_input.h"
#include "shade/gather/pixel_collector.h"
#include "shade/gather/pixel_sink.h"
#include "shade/setup/shading_setup.h"
#include "shade/shadow.h"
#include "shade/stage.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace scanout::shade {

class PrimitiveCache;

// There are four ways into a block: interior pixels in batches of a material or of a primitive
// (TilePixels), and edge pixels as rows of bits or as fragments (PixelCollector).
class BlockBuilder {
public:
    BlockBuilder();
    ~BlockBuilder();
    // For the tile that is shaded next; null: nothing was counted.
    void set_shadow(const TileShadow* shadow) { block_->shadow = shadow; }
    // Shades what was collected, of `visible` if by rows. Returns how many items that took.
    std::uint64_t shade(const GatherInput& input, PixelCollector& collected,
                        const raster::VisibilityTile* visible, const BlendedPixels* blended,
                        const PixelSink::Tile& tile, PixelSink& sink);

private:
    // What a block's items are for. It outlives no call of shade().
    struct Task {
        const GatherInput& in;
        PixelCollector& collected;
        const PixelSink::Tile& tile;
        PixelSink& sink;
    };
    void begin(const Task& task, const BlendedPixels* blended);
    void shade_interior_pixels(const Task& task);
    void shade_material_batch(const Task& task, const TilePixels::MaterialBatch& batch);
    void shade_primitive_batch(const Task& task, const TilePixels::PrimitiveBatch& batch);
    std::uint64_t shade_fragments(const Task& task);
    std::uint64_t shade_rows(const Task& task, const raster::VisibilityTile& visible);
    void add_fragment(const Task& task, const EdgeFragment& fragment);
    int add_edge_items(const Task& task, const raster::VisibilityTile& visible, int row, int sample,
                       const EdgeRow& found);
    bool is_set_up_per_item(const GatherInput& input, std::uint32_t id) const;
    const Primitive& primitive(const Task& task, std::uint32_t id);
    void add_unlit(const Task& task, std::uint32_t id, int count);
    void add_lit(const Task& task, const Primitive& primitive, int count);
    void begin_key(const Task& task, const ShadingKey& key);
    void place_block(const Task& task);
    void finish_block(const Task& task);
    void keep_layer_colours(ColourBlend::Of of, float white);
    const float* item_offsets(const Task& task);

    std::unique_ptr<PrimitiveCache> primitives_;
    std::unique_ptr<ShadingBlock> block_;
    std::unique_ptr<ShadingSetup> triangles_;
    std::unique_ptr<VertexLighting> vertex_lighting_; // while frames light vertices or faces
    TriangleSource item_source_{};                    // by the ids of interior pixels
    // Unclipped primitives are set up with their block, 8 side by side, not one by one when first
    // seen. Buys a tenth of the time of the bunny with Blinn-Phong.
    bool set_up_later_ = false;
    std::optional<ShadingKey> key_; // of the block
    int interior_count_ = 0;        // the block's first items, of interior pixels
    // Pixels of its items, in the tile: in the list of interior pixels, and behind it edge pixels.
    std::int32_t* pixel_ = nullptr;
    std::unique_ptr<Contribution[]> contributions_;             // of items of edge pixels
    std::array<std::uint16_t, raster::kTileSize> edge_index_{}; // of a row's pixels, in EdgePixels
    std::vector<float> offsets_;                                // dither of items; empty without
};

} // namespace scanout::shade
