#include "shade/gather/gather.h"

#include "image/dither.h"
#include "shade/check_lanes.h"
#include "shade/gather/gather_types.h"
#include "shade/gather/unlit.h"
#include "shade/setup/primitive_cache.h"
#include "shade/setup/shading_setup.h"
#include "shade/shading/vertex_lighting.h"
#include "shade/transparency/transparency_pass.h"

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>
#include <utility>

namespace scanout::shade {

using raster::kSubpixel;
using raster::kTileSize;

struct Gatherer::VisibleSurface {
    float depth; // at the first sample that shows it
    Fragment fragment;
};

namespace {

const scene::Material& default_material() {
    static const scene::Material material;
    return material;
}

// The maps of the block's material that some stage of the frame reads; alpha is known by now.
void bind_maps(ShadingBlock& b, const GatherInput& in) {
    for (std::size_t i = 0; i < kMaps; ++i) {
        const auto map = static_cast<Map>(i);
        const bool read = b.lit && (in.frame->attributes.maps & bit_of(map)) != 0 &&
                          (b.material->*map_slots()[i].map).texture >= 0;
        b.map[i] = read ? bound_map(in, map, *b.material) : BoundMap();
    }
}

// Of a tile: with fewer pixels a run, on the mean, its items set up triangles of their own as the
// pixels come; finding those of each triangle would take longer.
constexpr int kScattered = 2;

// Does a clipped triangle cover the point (1/256 pixel)?
bool covers(const GatherInput& in, std::uint32_t triangle, std::int32_t x, std::int32_t y) {
    const raster::ClippedTriangles clipped = in.geometry->clipped_of(triangle);
    return std::any_of(clipped.begin(), clipped.end(), [&](const raster::ClippedTriangle& one) {
        return raster::covers(one, x, y);
    });
}

} // namespace

raster::SampleOffset place_in_pixel(const GatherInput& in, const Primitive& t, int x, int y,
                                    raster::SampleOffset sample) {
    const raster::SampleOffset centre = {x * kSubpixel + raster::kPixelCentre.x,
                                         y * kSubpixel + raster::kPixelCentre.y};
    // The weights of what was clipped are rounded: there the exact edges decide.
    const auto inside = [&](int k) {
        return (t.a[k] * centre.x + t.b[k] * centre.y) + t.c[k] >= t.least[k];
    };
    const bool covered =
        t.clipped ? covers(in, t.id, centre.x, centre.y) : inside(0) && inside(1) && inside(2);
    return covered ? centre
                   : raster::SampleOffset{x * kSubpixel + sample.x, y * kSubpixel + sample.y};
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

std::uint16_t Gatherer::pixel_number(int x, int y) const {
    return static_cast<std::uint16_t>((y - area_.y0) * kTileSize + (x - area_.x0));
}

// The dither of a pixel of the tile.
float Gatherer::offset_at(int pixel) const {
    return image::dither_offset(static_cast<unsigned>(area_.x0 + pixel % kTileSize),
                                static_cast<unsigned>(area_.y0 + pixel / kTileSize));
}

// The surfaces of a pixel that has blended fragments, opaque ones among them, with their weights:
// in the order in which their sum is taken where nothing blends, by the first sample that shows
// them; then by depth there, and by id.
void Gatherer::collect_blended(const raster::VisibilityTile& tile, const GatherInput& in,
                               const BlendedPixels& blended, int x, int y) {
    const std::uint16_t pixel = pixel_number(x, y);
    const float* transmittance = blended.transmittance.data() + blended.slot[pixel];
    const float sample_weight = 1.0F / static_cast<float>(tile.samples());
    std::vector<VisibleSurface>& surfaces = surfaces_;
    surfaces.clear();
    float background = 0;
    const auto add = [&](std::uint32_t id, int sample, float depth, float weight, unsigned mask) {
        const raster::SampleOffset& at = tile.pattern()[static_cast<std::size_t>(sample)];
        surfaces.push_back({depth,
                            {id, in.keys.of(id), pixel, static_cast<std::uint8_t>(sample), 0,
                             static_cast<std::uint16_t>(edge_pixels_.size()), weight,
                             static_cast<std::uint16_t>(mask), byte_of(at.x), byte_of(at.y)}});
    };
    for (int s = 0; s < tile.samples(); ++s) {
        const std::uint32_t id = tile.id(x, y, s);
        const float weight = transmittance[s] * sample_weight;
        const auto known =
            std::find_if(surfaces.begin(), surfaces.end(),
                         [&](const VisibleSurface& other) { return other.fragment.id == id; });
        if (id == raster::kNoPrimitive)
            background += weight;
        else if (known != surfaces.end()) {
            known->fragment.weight += weight;
            known->fragment.samples = static_cast<std::uint16_t>(known->fragment.samples | 1U << s);
        } else if (weight > 0)
            add(id, s, tile.depth(x, y, s), weight, 1U << s);
    }
    for (const std::uint32_t i : blended.fragments(pixel)) {
        const BlendFragment& f = blended.list.fragments[i];
        if (f.weight == 0) continue;
        const int first = std::countr_zero(f.visible);
        add(f.id, first, blended.list.depth_at(f, first), f.weight, f.mask);
    }
    if (surfaces.empty()) return; // nothing shows but the background
    std::sort(surfaces.begin(), surfaces.end(),
              [](const VisibleSurface& a, const VisibleSurface& b) {
                  return std::tuple(a.fragment.sample, b.depth, a.fragment.id) <
                         std::tuple(b.fragment.sample, a.depth, b.fragment.id);
              });
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        surfaces[i].fragment.rank = static_cast<std::uint8_t>(std::min<std::size_t>(i, 255));
        fragments_.push_back(surfaces[i].fragment);
    }
    edge_pixels_.push_back(pixel);
    transmittance_.push_back(background);
}

// The columns of a part of a tile.
static std::uint64_t columns_of(const image::Rect& region) {
    const auto before = [](int x) { return x < kTileSize ? (std::uint64_t{1} << x) - 1 : ~0ULL; };
    return before(region.x1) & ~before(region.x0);
}

// Where nothing but small triangles shows, each pixel whole.
bool Gatherer::collect_small_triangles(const raster::VisibilityTile& tile, const GatherInput& in) {
    const std::vector<raster::BinnedList>* lists = tile.small_lists_alone();
    if (lists == nullptr || tile.samples() > 1 || !all_unclipped_ || !in.keys.only_material ||
        !interior_pixels_->take_small_triangles(*in.keys.only_material, *lists, tile.ids(0).data(),
                                                area_.width() * area_.height()))
        return false;
    item_source_.spatial_index = nullptr; // they are named by their places
    return true;
}

void Gatherer::collect(const raster::VisibilityTile& tile, const GatherInput& in,
                       const BlendedPixels* blended) {
    by_rows_ = false;
    if (blended == nullptr && collect_small_triangles(tile, in)) return;
    const image::Rect& in_picture = blended != nullptr ? blended->region : area_;
    const image::Rect region = {in_picture.x0 - area_.x0, in_picture.y0 - area_.y0,
                                in_picture.x1 - area_.x0, in_picture.y1 - area_.y0};
    TileRows rows;
    find_runs(tile, region.y0, region.y1, rows);
    const auto layered = [&](int row) {
        return blended != nullptr ? blended->rows[static_cast<std::size_t>(row)] : 0;
    };
    for (int row = region.y0; row < region.y1; ++row)
        rows[static_cast<std::size_t>(row)].edge |= layered(row);
    const std::uint64_t inside = columns_of(region);
    InteriorPixels interior;
    find_interior(rows, region.y0, region.y1, inside, interior);
    const bool scattered =
        in.keys.only_material && all_unclipped_ && interior.count < kScattered * interior.runs;
    by_rows_ = in.keys.only_material && all_unclipped_ && blended == nullptr &&
               sink_.filter == nullptr; // which asks what samples a fragment shows at
    if (!scattered) interior_pixels_->add_rows(tile.ids(0).data(), interior, region.y0, region.y1);
    for (int y = region.y0; y < region.y1; ++y) {
        const auto row = static_cast<std::size_t>(y);
        if (scattered)
            interior_pixels_->add_scattered(*in.keys.only_material,
                                            tile.ids(0).data() + row * kTileSize, y * kTileSize,
                                            interior.pixels[row]);
        const std::uint64_t edges = rows[row].edge & inside;
        if (by_rows_) {
            collect_edge_row(y, edges);
            continue;
        }
        for (std::uint64_t rest = edges; rest != 0; rest &= rest - 1) {
            const int x = std::countr_zero(rest);
            if ((layered(y) >> x & 1) == 0)
                collect_edge_pixel(tile, in, area_.x0 + x, area_.y0 + y);
            else if (blended->colour_blend != nullptr)
                collect_layers(tile, in, *blended, area_.x0 + x, area_.y0 + y);
            else
                collect_blended(tile, in, *blended, area_.x0 + x, area_.y0 + y);
        }
    }
}

void Gatherer::collect(raster::AreaTile& tile, const GatherInput& in) {
    std::uint32_t id = raster::kNoPrimitive; // of a run of pixels of its own
    int first = 0, count = 0;
    const auto end_run = [&] {
        if (count > 0) interior_pixels_->add(id, first, count);
        count = 0;
    };
    for (int y = area_.y0; y < area_.y1; ++y, end_run())
        for (int x = area_.x0; x < area_.x1; ++x) {
            const auto found = tile.fragments(x, y);
            const bool interior =
                !found.empty() && found[0].share == 1.0F; // then it is the only one
            if (!interior || found[0].id != id) end_run();
            if (found.empty()) continue;
            const std::uint16_t pixel = pixel_number(x, y);
            if (interior) {
                id = found[0].id;
                if (count++ == 0) first = pixel;
                continue;
            }
            float covered = 0;
            for (const raster::AreaFragment& f : found) {
                fragments_.push_back({f.id, in.keys.of(f.id), pixel, 0, 0,
                                      static_cast<std::uint16_t>(edge_pixels_.size()), f.share, 0,
                                      byte_of(f.x), byte_of(f.y)});
                covered += f.share;
            }
            edge_pixels_.push_back(pixel);
            transmittance_.push_back(covered > 1 - 0x1p-20F ? 0.0F : 1 - covered);
        }
}

// May its items set it up, each on its own?
bool Gatherer::is_set_up_per_item(const GatherInput& in, std::uint32_t id) const {
    return in.frame->per_item_setup && id < in.mesh->triangles() &&
           (all_unclipped_ || is_unclipped(source_, id));
}

// Whatever is added next looks like this.
void Gatherer::begin_key(const GatherInput& in, const ShadingKey& key, image::Image& picture) {
    ShadingBlock& b = *block_;
    finish_block(in, picture);
    key_ = key;
    b.lit = key.lit;
    b.material = &in.material(key.material);
    const bool matt = !b.lit || in.frame->is_matt(key.material);
    const auto surface = matt ? scene::Surface::matt : surface_of(*b.material);
    b.model = in.frame->reflection[static_cast<std::size_t>(surface)];
    bind_maps(b, in);
}

const Primitive& Gatherer::primitive(const GatherInput& in, std::uint32_t id,
                                     image::Image& picture) {
    if (primitives_->full()) {
        finish_block(in, picture);
        primitives_->clear();
    }
    return set_up_later_ ? primitives_->get_later(id) : primitives_->get(in, id);
}

// The next pixels of pixel_.
void Gatherer::add_unlit(const GatherInput& in, std::uint32_t id, int count) {
    ShadingBlock& b = *block_;
    for (int k = 0; k < count; ++k, ++b.count) {
        const int pixel = pixel_[b.count];
        const Vec3 colour = unlit_colour(in, *b.material, id, area_.x0 + pixel % kTileSize,
                                         area_.y0 + pixel / kTileSize);
        for (int c = 0; c < 3; ++c)
            b.albedo[c][b.count] = colour[c];
    }
}

// The next pixels of pixel_, interior ones of the primitive: what covers all samples covers the
// centre, which lies among them.
void Gatherer::add_lit(const Primitive& primitive, int count) {
    ShadingBlock& b = *block_;
    if (primitive.across < 0) return add_items(b, &primitive, count); // finish_block places them
    // Each of its two clipped triangles has one run in the block.
    std::array<std::int32_t, kBlockSize> of_second;
    std::int32_t* const of_first = pixel_ + b.count;
    int first = 0, second = 0;
    for (int k = 0; k < count; ++k) {
        const std::int32_t pixel = of_first[k];
        const std::int32_t x = (area_.x0 + pixel % kTileSize) * kSubpixel + raster::kPixelCentre.x;
        const std::int32_t y = (area_.y0 + pixel / kTileSize) * kSubpixel + raster::kPixelCentre.y;
        if (PrimitiveCache::is_of_second(primitive, x, y))
            of_second[static_cast<std::size_t>(second++)] = pixel;
        else
            of_first[first++] = pixel;
    }
    std::copy_n(of_second.data(), second, of_first + first);
    if (first > 0) add_items(b, &primitive, first);
    if (second > 0) add_items(b, &primitive + 1, second);
}

// Of the block's items; null where nothing is dithered.
const float* Gatherer::item_offsets(const GatherInput& in) {
    if (!in.output.dither) return nullptr;
    offsets_.resize(kPaddedBlock);
    for (std::size_t item = 0; item < static_cast<std::size_t>(block_->count); ++item)
        offsets_[item] = offset_at(pixel_[item]);
    return offsets_.data();
}

// Lanes of interior pixels, and those that have triangles of their own, which are set up there.
void Gatherer::place_block() {
    ShadingBlock& b = *block_;
    triangles_->centred = interior_count_;
    place_at_centres(b, pixel_, 0, interior_count_, area_.x0, area_.y0);
    for (int r = 0; r < b.runs; ++r) {
        const Run& run = b.run[r];
        if (run.primitive != nullptr) continue;
        const int others = std::max(run.first, interior_count_), end = run.first + run.count;
        if (others < end) place_at_centres(b, pixel_, others, end - others, area_.x0, area_.y0);
        set_up_run(item_source_, *triangles_, b, run.first, run.count);
    }
}

void Gatherer::finish_block(const GatherInput& in, image::Image& picture) {
    ShadingBlock& b = *block_;
    if (b.count == 0) return;
    if (b.lit) {
        if (set_up_later_) primitives_->set_up(source_);
        place_block();
    }
    if (b.lit && in.frame->attributes.ray) set_rays(b, in.rays);
    check_rays(b, *in.frame);
    for (const Stage* stage : in.stages) {
        stage->run(b, *in.frame);
        check_lanes(b, *in.frame, *stage);
    }
    const bool composes = b.blended != nullptr && b.blended->colour_blend != nullptr;
    if (in.linear != nullptr) {
        keep_linear(*in.linear);
        if (composes) keep_layer_colours(ColourBlend::Of::linear, 1);
    }
    std::array<std::uint32_t, kPaddedBlock> code;
    const bool sums_only = sink_.own != nullptr;
    if (!sums_only || in.output.blend_space->enter != nullptr)
        in.output.encoding->encode(
            {b.colour[0], b.colour[1], b.colour[2], nullptr, item_offsets(in)}, b.count,
            code.data());
    if (in.output.blend_space->enter != nullptr) in.output.blend_space->enter(b, code.data());
    if (composes) keep_layer_colours(ColourBlend::Of::blend_space, in.output.blend_space->white);
    if (sums_only)
        add_pixel_sums();
    else
        put_pixels(code.data(), picture);
    pixel_ += interior_count_;
    interior_count_ = b.count = b.runs = triangles_->count = 0;
}

// The pixels that a fragment fills as codes; the others add up.
void Gatherer::put_pixels(const std::uint32_t* code, image::Image& picture) {
    const ShadingBlock& b = *block_;
    store_codes(code, pixel_, interior_count_, &picture.at(area_.x0, area_.y0), picture.width());
    const Contribution* const contribution = contributions_.get();
    float *const red = sums_.red.data(), *const green = sums_.green.data(),
                 *const blue = sums_.blue.data();
    for (int item = interior_count_, end = b.count; item < end; ++item) {
        const std::uint16_t edge_pixel = contribution[item].edge_pixel;
        const float weight = contribution[item].weight;
        red[edge_pixel] += b.colour[0][item] * weight;
        green[edge_pixel] += b.colour[1][item] * weight;
        blue[edge_pixel] += b.colour[2][item] * weight;
    }
}

// All of them for a filter. What blends counts alike at all samples that it covers.
void Gatherer::add_pixel_sums() {
    if (sink_.filter == nullptr) return keep_linear(*sink_.own);
    const ShadingBlock& b = *block_;
    for (int item = 0; item < interior_count_; ++item) {
        const int pixel = pixel_[item];
        sink_.own->at(area_.x0 + pixel % kTileSize, area_.y0 + pixel / kTileSize) = {
            b.colour[0][item], b.colour[1][item], b.colour[2][item], 1.0F};
    }
    for (int item = interior_count_; item < b.count; ++item) {
        const auto& [edge_pixel, samples, weight, layer] =
            contributions_[static_cast<std::size_t>(item)];
        // 1 where it is opaque.
        const float each =
            weight * static_cast<float>(samples_) / static_cast<float>(std::popcount(samples));
        for (std::size_t cell = 0; cell < kCells; ++cell) {
            const float cell_weight = sink_.filter->weight(cell, samples) * each;
            std::array<float, 4>& splat = splats_[edge_pixel][cell];
            for (std::size_t c = 0; c < 3; ++c)
                splat[c] += b.colour[c][item] * cell_weight;
            splat[3] += cell_weight;
        }
    }
}

// Adds the block's items; pixels that fragments share are summed in the order of their blocks.
void Gatherer::keep_linear(LinearPicture& linear) const {
    for (int item = 0; item < block_->count; ++item) {
        const int pixel = pixel_[item];
        const float weight =
            item < interior_count_ ? 1 : contributions_[static_cast<std::size_t>(item)].weight;
        std::array<float, 4>& sum =
            linear.at(area_.x0 + pixel % kTileSize, area_.y0 + pixel / kTileSize);
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += block_->colour[c][item] * weight;
        sum[3] += weight;
    }
}

void Gatherer::begin(const GatherInput& in, const image::Rect& area, int samples,
                     const BlendedPixels* blended) {
    if (in.frame->per_item_setup) item_source_ = source_ = triangle_source(in);
    all_unclipped_ = in.frame->per_item_setup && in.geometry->all_unclipped();
    set_up_later_ = all_unclipped_ && in.frame->steps == nullptr;
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
    primitives_->clear();
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
