// From a tile's visibility buffer to blocks of items and on to the picture's pixels: visible pixels
// are collected across triangles, 128 a block, one material a block; each triangle is shaded once a
// pixel, at the centre if it covers it, else at its first visible sample.
#pragma once

#include "geom/mesh.h"
#include "image/image.h"
#include "raster/stage/geometry.h"
#include "raster/tile/area.h"
#include "raster/tile/tile.h"
#include "scene/view.h"
#include "shade/gather/block_pixels.h"
#include "shade/gather/edge_row.h"
#include "shade/gather/shading_key.h"
#include "shade/gather/tile_pixels.h"
#include "shade/mip/mip_chain.h"
#include "shade/resolve/linear_picture.h"
#include "shade/resolve/output.h"
#include "shade/resolve/reconstruction_filter.h"
#include "shade/resolve/resolve.h"
#include "shade/setup/shading_setup.h"
#include "shade/stage.h"
#include "shade/transparency.h"
#include "shade/transparency/colour_blend.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace scanout::shade {

// What is not opaque, and how it is drawn.
struct TransparencyInput {
    const Transparency* cut_out = nullptr; // null where no triangle wants it
    const Transparency* blended = nullptr;
    const Blend* blend = nullptr;
    bool opaque_blended = false;          // all that is blended has alpha 1
    std::span<const MaterialAlpha> alpha; // of the default material, then of each of the scene
    std::span<const Stage* const> stages; // find alpha
    FrameState frame;                     // of those stages
    float cut = 0.5F;                     // least alpha that is drawn
    std::size_t max_fragments = 0;        // of a list; what is drawn does not depend on it
};

struct BlendedPixels;
class PrimitiveCache;

// What shading a tile needs to know of the frame.
struct GatherInput {
    const geom::Mesh* mesh = nullptr;
    ShadingKeys keys; // of the mesh
    const raster::Geometry* geometry = nullptr;
    const raster::ScreenTransform* transform = nullptr;
    const scene::View* view = nullptr;
    double unit = 1; // scene::to_floats of the view
    std::span<const scene::Material> materials;
    std::span<const scene::Texture> textures;
    const MipChains* mips = nullptr;
    std::optional<Wrap> wrap; // of every map; else as each says
    std::span<const Stage* const> stages;
    const FrameState* frame = nullptr;
    bool mirrored = false;
    Rays rays;
    image::Rgba8 background{};
    Output output;
    LinearPicture* linear = nullptr;                 // also kept there
    const TransparencyInput* transparency = nullptr; // null where all is opaque

    void set_view(const scene::View& of) {
        view = &of;
        unit = scene::to_floats(of);
    }
    const scene::Material& material(std::int32_t index) const; // -1: the default material
};

// A map of a material, ready to be read: it has a texture.
BoundMap bound_map(const GatherInput& input, Map map, const scene::Material& material);

// Where a triangle is shaded in a pixel, 1/256 pixel of the picture: at the centre where it covers
// it, else at a sample that it covers.
raster::SampleOffset place_in_pixel(const GatherInput& input, const Primitive& primitive, int x,
                                    int y, raster::SampleOffset sample);

// Where sums over samples go, in the blend space, when a filter has yet to resolve them.
struct PixelSumSink {
    LinearPicture* own = nullptr; // null: pixels are made at once
    // Of pixels that fragments share, what goes to their neighbours; else all adds up in own.
    const ReconstructionFilter* filter = nullptr;
    SplatPicture* splats = nullptr;
};

// One a worker: the block and the lists live from tile to tile.
class Gatherer {
public:
    Gatherer();
    ~Gatherer();
    // For the tile that is shaded next; null: nothing was counted.
    void set_shadow(const TileShadow* shadow);
    // Writes every pixel of the tile that shows a primitive, and no other. With blended fragments:
    // of their region of the tile. Returns how many items were shaded.
    std::uint64_t shade(const raster::VisibilityTile& tile, const GatherInput& input,
                        image::Image& picture, const BlendedPixels* blended = nullptr);

    // The same by areas, where all is opaque.
    std::uint64_t shade(raster::AreaTile& tile, const GatherInput& input, image::Image& picture);
    // From now on.
    void set_sum_sink(const PixelSumSink& sink) { sink_ = sink; }

private:
    struct Fragment;
    void collect(const raster::VisibilityTile& tile, const GatherInput& input,
                 const BlendedPixels* blended);
    bool collect_small_triangles(const raster::VisibilityTile& tile, const GatherInput& input);
    void collect_blended(const raster::VisibilityTile& tile, const GatherInput& input,
                         const BlendedPixels& blended, int x, int y);
    void collect_layers(const raster::VisibilityTile& tile, const GatherInput& input,
                        const BlendedPixels& blended, int x, int y);
    template <int kSamples>
    void collect_samples(const raster::VisibilityTile& tile, const GatherInput& input,
                         std::uint16_t pixel);
    void collect_edge_pixel(const raster::VisibilityTile& tile, const GatherInput& input, int x,
                            int y);
    void collect_edge_row(int row, std::uint64_t edges);
    void collect(raster::AreaTile& tile, const GatherInput& input);
    void sort_fragments();
    bool is_set_up_per_item(const GatherInput& input, std::uint32_t id) const;
    void begin(const GatherInput& input, const image::Rect& area, int samples,
               const BlendedPixels* blended);
    std::uint64_t shade_collected(const GatherInput& input, image::Image& picture,
                                  const raster::VisibilityTile* rows);
    void shade_interior_pixels(const GatherInput& input, image::Image& picture);
    void shade_material_batch(const TilePixels::MaterialBatch& batch, const GatherInput& input,
                              image::Image& picture);
    void shade_primitive_batch(const TilePixels::PrimitiveBatch& batch, const GatherInput& input,
                               image::Image& picture);
    std::uint64_t shade_fragments(const GatherInput& input, image::Image& picture);
    void add_fragment(const GatherInput& input, const Fragment& fragment, image::Image& picture);
    std::uint64_t shade_rows(const raster::VisibilityTile& tile, const GatherInput& input,
                             image::Image& picture);
    int add_edge_items(const raster::VisibilityTile& tile, int row, int sample,
                       const EdgeRow& found, const GatherInput& input, image::Image& picture);
    void place_block();
    void begin_key(const GatherInput& input, const ShadingKey& key, image::Image& picture);
    const Primitive& primitive(const GatherInput& input, std::uint32_t id, image::Image& picture);
    void add_unlit(const GatherInput& input, std::uint32_t id, int count);
    void add_lit(const Primitive& primitive, int count);
    void finish_block(const GatherInput& input, image::Image& picture);
    void store_pixels(const std::uint32_t* code, image::Image& picture);
    void add_pixel_sums();
    // Of pixels whose layers' colours decide (gather_composed.cpp).
    void keep_layer_colours(ColourBlend::Of of, float white);
    void blend_layers(const GatherInput& input);
    void blend_layers(const ColourBlend::Pixel& pixel, ColourBlend::Of of,
                      const GatherInput& input);
    void add_linear(LinearPicture& linear) const;
    std::uint16_t pixel_number(int x, int y) const {
        return static_cast<std::uint16_t>((y - area_.y0) * raster::kTileSize + (x - area_.x0));
    }
    float offset_at(int pixel) const;
    const float* item_offsets(const GatherInput& input);
    void resolve_edge_pixels(const GatherInput& input, image::Image& picture);
    void store_splats();

    image::Rect area_; // of the tile
    int samples_ = 1;  // of a pixel of it
    PixelSumSink sink_;
    // Interior pixels. Triangles with few of them in the tile are set up in the block, if the frame
    // allows it; others once in primitives_.
    std::unique_ptr<TilePixels> interior_pixels_;
    TriangleSource item_source_{}; // by id, or by spatial index after take_small_triangles()
    bool all_unclipped_ = false;   // every triangle can be set up in the block
    // Unclipped primitives are set up with their block, 8 side by side, not one by one when first
    // seen. Buys a tenth of the time of the bunny with Blinn-Phong.
    bool set_up_later_ = false;
    std::vector<Fragment> fragments_;
    // Edge pixels are bits of the tile's rows, not fragments of a list: all primitives have one
    // key, and every triangle can be set up in the block. Buys 57 M of 319 M instructions of the
    // bunny with 4 samples.
    bool by_rows_ = false;
    std::array<std::uint64_t, raster::kTileSize> edge_bits_{};
    std::array<std::uint16_t, raster::kTileSize>
        edge_index_{};     // of a row's pixels, in the list of edge pixels
    struct VisibleSurface; // a fragment of one pixel
    std::vector<VisibleSurface> surfaces_;
    std::unique_ptr<PrimitiveCache> primitives_;
    std::unique_ptr<ShadingBlock> block_;
    std::unique_ptr<ShadingSetup> triangles_;
    std::unique_ptr<VertexLighting> vertex_lighting_; // while frames light vertices or faces
    std::optional<ShadingKey> key_;                   // of the block
    // Where its items' light goes: the first `interior_count_` are of interior pixels, the others
    // contribute to edge pixels.
    struct Contribution;
    int interior_count_ = 0;
    // Pixels of its items, in the tile: in the list of interior_pixels_, and behind it edge pixels.
    std::int32_t* pixel_ = nullptr;
    std::unique_ptr<Contribution[]> contributions_;
    PixelSums sums_;                  // of the pixels in edge_pixels_
    std::vector<FilterSplat> splats_; // of the same
    std::vector<std::uint16_t> edge_pixels_;
    std::vector<float> transmittance_; // of each: the weight of the background
    std::vector<std::uint32_t> codes_;
    std::vector<float> offsets_; // dither of items or of edge pixels; empty without
};

} // namespace scanout::shade
