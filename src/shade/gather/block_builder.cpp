#include "shade/gather/block_builder.h"

#include "shade/check_lanes.h"
#include "shade/gather/unlit.h"
#include "shade/setup/primitive_cache.h"
#include "shade/shading/vertex_lighting.h"
#include "shade/transparency/transparency_pass.h"

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

namespace scanout::shade {

using raster::kSubpixel;
using raster::kTileSize;
using raster::VisibilityTile;

// The maps of the block's material that some stage of the frame reads; alpha is known by now.
static void bind_maps(ShadingBlock& b, const GatherInput& in) {
    for (std::size_t i = 0; i < kMaps; ++i) {
        const auto map = static_cast<Map>(i);
        const bool read = b.lit && (in.frame->attributes.maps & bit_of(map)) != 0 &&
                          (b.material->*map_slots()[i].map).texture() >= 0;
        b.map[i] = read ? bound_map(in, map, *b.material) : BoundMap();
    }
}

BlockBuilder::BlockBuilder()
    : primitives_(std::make_unique<PrimitiveCache>()), block_(std::make_unique<ShadingBlock>()),
      triangles_(std::make_unique<ShadingSetup>()),
      contributions_(std::make_unique<Contribution[]>(kBlockSize)) {
    block_->triangles = triangles_.get();
}
BlockBuilder::~BlockBuilder() = default;

void BlockBuilder::begin(const Task& task, const BlendedPixels* blended) {
    const FrameState& frame = *task.in.frame;
    primitives_->begin(task.in);
    item_source_ = primitives_->source();
    if (task.collected.has_spatial_indices()) item_source_.spatial_index = nullptr;
    set_up_later_ = frame.per_item_setup;
    pixel_ = task.collected.interior_pixels().pixels();
    ShadingBlock& b = *block_;
    b.blended = blended;
    b.ambient = Vec3(0);
    b.hemispheres = false;
    if (frame.attributes.vertices && vertex_lighting_ == nullptr) {
        vertex_lighting_ = std::make_unique<VertexLighting>();
        b.vertex_lighting = vertex_lighting_.get();
    }
    if (!frame.varies.empty()) b.light.resize(frame.lights.size());
    check_lights(frame);
    key_.reset();
}

std::uint64_t BlockBuilder::shade(const GatherInput& in, PixelCollector& collected,
                                  const VisibilityTile* visible, const BlendedPixels* blended,
                                  const PixelSink::Tile& tile, PixelSink& sink) {
    const Task task{in, collected, tile, sink};
    begin(task, blended);
    shade_interior_pixels(task);
    const std::uint64_t items =
        collected.interior_pixels().size() +
        (collected.by_rows() ? shade_rows(task, *visible) : shade_fragments(task));
    finish_block(task);
    return items;
}

// May its items set it up, each on its own?
bool BlockBuilder::is_set_up_per_item(const GatherInput& in, std::uint32_t id) const {
    return in.frame->per_item_setup && id < in.mesh->triangles() && primitives_->unclipped(id);
}

// In the order of their list.
void BlockBuilder::shade_interior_pixels(const Task& task) {
    TilePixels& pixels = task.collected.interior_pixels();
    if (task.in.frame->per_item_setup && primitives_->all_unclipped())
        pixels.arrange(task.in.keys, [](std::uint32_t) { return true; });
    else
        pixels.arrange(task.in.keys,
                       [&](std::uint32_t id) { return is_set_up_per_item(task.in, id); });
    for (const TilePixels::MaterialBatch& batch : pixels.material_batches())
        shade_material_batch(task, batch);
    for (const TilePixels::PrimitiveBatch& batch : pixels.primitive_batches())
        shade_primitive_batch(task, batch);
}

void BlockBuilder::shade_material_batch(const Task& task, const TilePixels::MaterialBatch& batch) {
    ShadingBlock& b = *block_;
    ShadingSetup& t = *triangles_;
    const ShadingKey key = {batch.material, true};
    if (key_ != key) begin_key(task, key);
    const std::int32_t* const triangle = task.collected.interior_pixels().triangles();
    const std::uint32_t* const ids = task.collected.interior_pixels().ids();
    for (std::size_t i = batch.first; i < batch.end;) {
        if (b.count == kBlockSize) finish_block(task);
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

void BlockBuilder::shade_primitive_batch(const Task& task,
                                         const TilePixels::PrimitiveBatch& batch) {
    ShadingBlock& b = *block_;
    if (key_ != batch.key) begin_key(task, batch.key);
    const Primitive* of = b.lit ? &primitive(task, batch.id) : nullptr;
    for (int left = static_cast<int>(batch.count); left > 0;) {
        if (b.count == kBlockSize) finish_block(task);
        const int count = std::min(left, kBlockSize - b.count);
        if (of != nullptr)
            add_lit(task, *of, count);
        else
            add_unlit(task, batch.id, count);
        interior_count_ = b.count;
        left -= count;
    }
}

// Ends the block: what is added next has this key.
void BlockBuilder::begin_key(const Task& task, const ShadingKey& key) {
    ShadingBlock& b = *block_;
    finish_block(task);
    key_ = key;
    b.lit = key.lit;
    b.material = &task.in.material(key.material);
    b.occluded = !task.in.frame->is_blended(key.material);
    b.uv_step = task.in.uv_step(key.material);
    const bool matt = !b.lit || task.in.frame->is_matt(key.material);
    const auto surface = matt ? scene::Surface::matt : surface_of(*b.material);
    b.model = task.in.frame->reflection[static_cast<std::size_t>(surface)];
    bind_maps(b, task.in);
}

const Primitive& BlockBuilder::primitive(const Task& task, std::uint32_t id) {
    if (primitives_->full()) {
        finish_block(task);
        primitives_->clear();
    }
    return set_up_later_ ? primitives_->get_later(id) : primitives_->get(id);
}

// The next pixels of pixel_.
void BlockBuilder::add_unlit(const Task& task, std::uint32_t id, int count) {
    ShadingBlock& b = *block_;
    const image::Rect& area = task.tile.area;
    for (int k = 0; k < count; ++k, ++b.count) {
        const int pixel = pixel_[b.count];
        const Vec3 colour = unlit_colour(task.in, *b.material, id, area.x0 + column_of(pixel),
                                         area.y0 + row_of(pixel));
        for (int c = 0; c < 3; ++c)
            b.albedo[c][b.count] = colour[c];
    }
}

// The next pixels of pixel_, interior ones of the primitive: what covers all samples covers the
// centre, which lies among them.
void BlockBuilder::add_lit(const Task& task, const Primitive& primitive, int count) {
    ShadingBlock& b = *block_;
    if (primitive.across < 0) return add_items(b, &primitive, count); // finish_block places them
    // Each of its two clipped triangles has one run in the block.
    std::array<std::int32_t, kBlockSize> of_second;
    std::int32_t* const of_first = pixel_ + b.count;
    int first = 0, second = 0;
    const image::Rect& area = task.tile.area;
    for (int k = 0; k < count; ++k) {
        const std::int32_t pixel = of_first[k];
        const std::int32_t x = (area.x0 + column_of(pixel)) * kSubpixel + raster::kPixelCentre.x;
        const std::int32_t y = (area.y0 + row_of(pixel)) * kSubpixel + raster::kPixelCentre.y;
        if (PrimitiveCache::is_of_second(primitive, x, y))
            of_second[static_cast<std::size_t>(second++)] = pixel;
        else
            of_first[first++] = pixel;
    }
    std::copy_n(of_second.data(), second, of_first + first);
    if (first > 0) add_items(b, &primitive, first);
    if (second > 0) add_items(b, &primitive + 1, second);
}

// Sets the sample positions of interior pixels, and sets up the triangles of runs without a
// primitive.
void BlockBuilder::place_block(const Task& task) {
    ShadingBlock& b = *block_;
    const image::Rect& area = task.tile.area;
    triangles_->centred = interior_count_;
    place_at_centres(b, pixel_, 0, interior_count_, area.x0, area.y0);
    for (int r = 0; r < b.runs; ++r) {
        const Run& run = b.run[r];
        if (run.primitive != nullptr) continue;
        const int others = std::max(run.first, interior_count_), end = run.first + run.count;
        if (others < end) place_at_centres(b, pixel_, others, end - others, area.x0, area.y0);
        set_up_run(item_source_, *triangles_, b, run.first, run.count);
    }
}

void BlockBuilder::finish_block(const Task& task) {
    ShadingBlock& b = *block_;
    if (b.count == 0) return;
    const GatherInput& in = task.in;
    if (b.lit) {
        if (set_up_later_) primitives_->set_up();
        place_block(task);
    }
    if (b.lit && in.frame->attributes.ray) set_rays(b, in.rays);
    check_rays(b, *in.frame);
    for (const Stage* stage : in.stages) {
        stage->run(b, *in.frame);
        check_lanes(b, *in.frame, *stage);
    }
    std::array<std::uint32_t, kPaddedBlock> code;
    const ShadedItems items{b, pixel_, interior_count_, contributions_.get(), code.data()};
    const bool composes = b.blended != nullptr && b.blended->colour_blend != nullptr;
    if (in.linear != nullptr) {
        add_linear(*in.linear, task.tile.area, items);
        if (composes) keep_layer_colours(ColourBlend::Of::linear, 1);
    }
    const BlendSpace& space = *in.output.blend_space;
    if (task.sink.wants_codes() || space.enter != nullptr)
        in.output.encoding->encode(
            {b.colour[0], b.colour[1], b.colour[2], nullptr, item_offsets(task)}, b.count,
            code.data());
    if (space.enter != nullptr) space.enter(b, code.data());
    if (composes) keep_layer_colours(ColourBlend::Of::blend_space, space.white);
    task.sink.store(task.tile, items);
    pixel_ += interior_count_;
    interior_count_ = b.count = b.runs = triangles_->count = 0;
}

// Of pixels whose layers' colours decide.
void BlockBuilder::keep_layer_colours(ColourBlend::Of of, float white) {
    const ShadingBlock& b = *block_;
    for (int item = interior_count_; item < b.count; ++item) {
        const std::uint32_t layer = contributions_[static_cast<std::size_t>(item)].layer;
        if (layer == kNoLayer) continue;
        LayerColour colour;
        for (std::size_t c = 0; c < 3; ++c)
            colour[c] = b.colour[c][item] / white;
        b.blended->colour_blend->set(of, layer, colour);
    }
}

// Of the block's items; null where nothing is dithered.
const float* BlockBuilder::item_offsets(const Task& task) {
    if (!task.in.output.dither) return nullptr;
    offsets_.resize(kPaddedBlock);
    for (std::size_t item = 0; item < static_cast<std::size_t>(block_->count); ++item)
        offsets_[item] = dither_at(task.tile.area, pixel_[item]);
    return offsets_.data();
}

// One material a block; the order inside a material stays that of the pixels.
static void sort_by_key(std::vector<EdgeFragment>& fragments) {
    const auto key = [](const EdgeFragment& f) {
        return std::tuple(f.key.lit, f.key.material, f.rank);
    };
    const auto differs = [&](const EdgeFragment& a, const EdgeFragment& b) {
        return key(a) != key(b);
    };
    if (std::adjacent_find(fragments.begin(), fragments.end(), differs) != fragments.end())
        std::stable_sort(
            fragments.begin(), fragments.end(),
            [&](const EdgeFragment& a, const EdgeFragment& b) { return key(a) < key(b); });
}

// The next item, a fragment's.
void BlockBuilder::add_fragment(const Task& task, const EdgeFragment& f) {
    ShadingBlock& b = *block_;
    const bool own = is_set_up_per_item(task.in, f.id);
    const Primitive* of = b.lit && !own ? &primitive(task, f.id) : nullptr; // may end the block
    const auto item = static_cast<std::size_t>(b.count);
    pixel_[item] = f.pixel;
    contributions_[item] = {f.edge_pixel, f.samples, f.weight, f.layer};
    if (own) {
        triangles_->triangle_of[item] = triangles_->count;
        triangles_->id[triangles_->count++] = f.id;
        triangles_->sample_x[item] = f.at_x - raster::kPixelCentre.x;
        triangles_->sample_y[item] = f.at_y - raster::kPixelCentre.y;
        add_items(b, nullptr, 1);
    } else if (of != nullptr) {
        const image::Rect& area = task.tile.area;
        const auto [x, y] = place_in_pixel(task.in, *of, area.x0 + column_of(f.pixel),
                                           area.y0 + row_of(f.pixel), {f.at_x, f.at_y});
        add_item(b, PrimitiveCache::at(*of, x, y), x, y);
    } else {
        add_unlit(task, f.id, 1);
    }
}

std::uint64_t BlockBuilder::shade_fragments(const Task& task) {
    ShadingBlock& b = *block_;
    std::vector<EdgeFragment>& fragments = task.collected.fragments();
    if (!task.in.keys.only_material || b.blended != nullptr) sort_by_key(fragments);
    for (const EdgeFragment& f : fragments) {
        if (key_ != f.key) begin_key(task, f.key);
        if (b.count == kBlockSize) finish_block(task);
        add_fragment(task, f);
    }
    return fragments.size();
}

// What a row's edge pixels show first at a sample, as items. Returns how many.
int BlockBuilder::add_edge_items(const Task& task, const VisibilityTile& visible, int row,
                                 int sample, const EdgeRow& found) {
    ShadingBlock& b = *block_;
    const auto s = static_cast<std::size_t>(sample);
    const int count = std::popcount(found.first[s]);
    if (count == 0) return 0;
    if (b.count + count > kBlockSize) finish_block(task);
    const std::uint32_t* ids = visible.ids(sample).data() + std::ptrdiff_t{row} * kTileSize;
    const float* coverage = found.coverage[s];
    const raster::SampleOffset at = visible.pattern()[s];
    const std::int32_t right = at.x - raster::kPixelCentre.x, down = at.y - raster::kPixelCentre.y;
    ShadingSetup& t = *triangles_;
    std::int32_t* const pixel = pixel_;
    Contribution* const contribution = contributions_.get();
    int item = b.count, triangle = t.count;
    std::uint32_t last = ids[std::countr_zero(found.first[s])]; // neighbours may show the same
    for (std::uint64_t rest = found.first[s]; rest != 0; rest &= rest - 1, ++item) {
        const int x = std::countr_zero(rest);
        triangle += ids[x] != last ? 1 : 0;
        last = ids[x];
        t.triangle_of[item] = triangle;
        t.id[triangle] = last;
        t.sample_x[item] = right;
        t.sample_y[item] = down;
        pixel[item] = row * kTileSize + x;
        contribution[item] = {edge_index_[static_cast<std::size_t>(x)], 0, coverage[x], kNoLayer};
    }
    t.count = triangle + 1;
    add_items(b, nullptr, count);
    return count;
}

// A pixel's sum takes what it shows in the order of the samples that show it first, as from the
// list of fragments.
std::uint64_t BlockBuilder::shade_rows(const Task& task, const VisibilityTile& visible) {
    EdgePixels& edges = task.collected.edge_pixels();
    if (edges.pixel.empty()) return 0;
    const ShadingKey key = {*task.in.keys.only_material, true};
    if (key_ != key) begin_key(task, key);
    edges.transmittance.resize(edges.pixel.size());
    std::uint64_t items = 0;
    std::uint16_t index = 0;
    for (int row = 0; row < task.tile.area.height(); ++row) {
        const std::uint64_t in_row = task.collected.rows()[static_cast<std::size_t>(row)];
        if (in_row == 0) continue;
        EdgeRow found;
        find_edge_row(visible, row, in_row, found);
        for (std::uint64_t rest = in_row; rest != 0; rest &= rest - 1) {
            const int x = std::countr_zero(rest);
            edge_index_[static_cast<std::size_t>(x)] = index;
            edges.transmittance[index++] = found.transmittance[x];
        }
        for (int s = 0; s < visible.samples(); ++s)
            items += static_cast<std::uint64_t>(add_edge_items(task, visible, row, s, found));
    }
    return items;
}

} // namespace scanout::shade
