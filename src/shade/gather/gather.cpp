#include "shade/gather/gather.h"

#include "shade/check_lanes.h"
#include "shade/gather/gather_types.h"
#include "shade/setup/primitive_cache.h"
#include "shade/shading/vertex_lighting.h"
#include "shade/transparency/transparency_pass.h"

#include <algorithm>

namespace scanout::shade {

static const scene::Material& default_material() {
    static const scene::Material material;
    return material;
}

BoundMap bound_map(const GatherInput& in, Map map, const scene::Material& material) {
    const scene::TextureMap& options = material.*map_slots()[map].map;
    return {&in.textures[static_cast<std::size_t>(options.texture)], &options,
            in.mips->find(mip_use(map, options)),
            in.wrap.value_or(options.clamp ? Wrap::clamp : Wrap::repeat)};
}

const scene::Material& GatherInput::material(std::int32_t index) const {
    return index >= 0 ? materials[static_cast<std::size_t>(index)] : default_material();
}

Gatherer::Gatherer()
    : interior_pixels_(std::make_unique<TilePixels>()),
      primitives_(std::make_unique<PrimitiveCache>()), block_(std::make_unique<ShadingBlock>()),
      triangles_(std::make_unique<ShadingSetup>()),
      contributions_(std::make_unique<Contribution[]>(kBlockSize)) {
    block_->triangles = triangles_.get();
}
Gatherer::~Gatherer() = default;

void Gatherer::set_shadow(const TileShadow* shadow) {
    block_->shadow = shadow;
}

void Gatherer::begin(const GatherInput& in, const image::Rect& area, int samples,
                     const BlendedPixels* blended) {
    primitives_->begin(in);
    item_source_ = primitives_->source();
    all_unclipped_ = in.frame->per_item_setup && in.geometry->all_unclipped();
    set_up_later_ = in.frame->per_item_setup;
    interior_pixels_->clear();
    area_ = area;
    pixel_ = interior_pixels_->pixels();
    samples_ = samples;
    block_->blended = blended;
    fragments_.clear();
    edge_pixels_.clear();
    transmittance_.clear();
}

std::uint64_t Gatherer::shade(const raster::VisibilityTile& tile, const GatherInput& in,
                              image::Image& picture, const BlendedPixels* blended) {
    begin(in, tile.area(), tile.samples(), blended);
    collect(tile, in, blended);
    return shade_collected(in, picture, by_rows_ ? &tile : nullptr);
}

std::uint64_t Gatherer::shade(raster::AreaTile& tile, const GatherInput& in,
                              image::Image& picture) {
    begin(in, tile.area(), 1, nullptr);
    collect(tile, in);
    return shade_collected(in, picture, nullptr);
}

void Gatherer::shade_material_batch(const TilePixels::MaterialBatch& batch, const GatherInput& in,
                                    image::Image& picture) {
    ShadingBlock& b = *block_;
    ShadingSetup& t = *triangles_;
    const ShadingKey key = {batch.material, true};
    if (key_ != key) begin_key(in, key, picture);
    const std::int32_t* const triangle = interior_pixels_->triangles();
    const std::uint32_t* const ids = interior_pixels_->ids();
    for (std::size_t i = batch.first; i < batch.end;) {
        if (b.count == kBlockSize) finish_block(in, picture);
        const std::size_t count =
            std::min(batch.end - i, static_cast<std::size_t>(kBlockSize - b.count));
        assign_triangles(triangle + i, ids, static_cast<int>(count), t, b.count);
        // The next block's: the file may have them far from each other.
        if (item_source_.spatial_index != nullptr) {
            const std::int32_t next = triangle[i + count - 1] + 1, as_many = next - triangle[i],
                               end = std::min(next + as_many, triangle[batch.end - 1] + 1);
            for (std::int32_t k = next; k < end; ++k)
                prefetch_spatial_index(item_source_, ids[k]);
        }
        add_items(b, nullptr, static_cast<int>(count));
        interior_count_ = b.count;
        i += count;
    }
}

void Gatherer::shade_primitive_batch(const TilePixels::PrimitiveBatch& batch, const GatherInput& in,
                                     image::Image& picture) {
    ShadingBlock& b = *block_;
    if (key_ != batch.key) begin_key(in, batch.key, picture);
    const Primitive* of = b.lit ? &primitive(in, batch.id, picture) : nullptr;
    for (int left = static_cast<int>(batch.count); left > 0;) {
        if (b.count == kBlockSize) finish_block(in, picture);
        const int count = std::min(left, kBlockSize - b.count);
        if (of != nullptr)
            add_lit(*of, count);
        else
            add_unlit(in, batch.id, count);
        interior_count_ = b.count;
        left -= count;
    }
}

// In the order of their list.
void Gatherer::shade_interior_pixels(const GatherInput& in, image::Image& picture) {
    if (all_unclipped_)
        interior_pixels_->arrange(in.keys, [](std::uint32_t) { return true; });
    else
        interior_pixels_->arrange(in.keys,
                                  [&](std::uint32_t id) { return is_set_up_per_item(in, id); });
    for (const TilePixels::MaterialBatch& batch : interior_pixels_->material_batches())
        shade_material_batch(batch, in, picture);
    for (const TilePixels::PrimitiveBatch& batch : interior_pixels_->primitive_batches())
        shade_primitive_batch(batch, in, picture);
}

// rows: the tile whose edge pixels are bits of rows; null: they are fragments.
std::uint64_t Gatherer::shade_collected(const GatherInput& in, image::Image& picture,
                                        const raster::VisibilityTile* rows) {
    static_assert(sizeof(image::Rgba8) == sizeof(std::uint32_t));
    if (sink_.filter != nullptr)
        splats_.assign(edge_pixels_.size(), {});
    else
        sums_.reset(edge_pixels_.size());
    ShadingBlock& b = *block_;
    b.ambient = Vec3(0);
    if (in.frame->attributes.vertices && vertex_lighting_ == nullptr) {
        vertex_lighting_ = std::make_unique<VertexLighting>();
        b.vertex_lighting = vertex_lighting_.get();
    }
    if (!in.frame->varies.empty()) b.light.resize(in.frame->lights.size());
    check_lights(*in.frame);
    key_.reset();
    shade_interior_pixels(in, picture);
    std::uint64_t items = interior_pixels_->size();
    items += rows != nullptr ? shade_rows(*rows, in, picture) : shade_fragments(in, picture);
    finish_block(in, picture);
    if (b.blended != nullptr && b.blended->colour_blend != nullptr) blend_layers(in);
    if (sink_.filter != nullptr)
        store_splats();
    else if (!edge_pixels_.empty() && sink_.own == nullptr)
        resolve_edge_pixels(in, picture);
    return items;
}

} // namespace scanout::shade
