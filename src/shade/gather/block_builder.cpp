// The gatherer's second part: fills blocks with items of one key, and runs the stages over those
// that are full.
#include "shade/check_lanes.h"
#include "shade/gather/gather_types.h"
#include "shade/gather/unlit.h"
#include "shade/setup/primitive_cache.h"
#include "shade/setup/shading_setup.h"
#include "shade/transparency/transparency_pass.h"

#include <algorithm>
#include <array>
#include <bit>
#include <tuple>

namespace scanout::shade {

using raster::kSubpixel;
using raster::kTileSize;

namespace {

// The maps of the block's material that some stage of the frame reads; alpha is known by now.
void bind_maps(ShadingBlock& b, const GatherInput& in) {
    for (std::size_t i = 0; i < kMaps; ++i) {
        const auto map = static_cast<Map>(i);
        const bool read = b.lit && (in.frame->attributes.maps & bit_of(map)) != 0 &&
                          (b.material->*map_slots()[i].map).texture >= 0;
        b.map[i] = read ? bound_map(in, map, *b.material) : BoundMap();
    }
}

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

// Ends the block: what is added next has this key.
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
    return set_up_later_ ? primitives_->get_later(id) : primitives_->get(id);
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

// Sets the sample positions of interior pixels, and sets up the triangles of runs without a
// primitive.
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
        if (set_up_later_) primitives_->set_up();
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
        add_linear(*in.linear);
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
        store_pixels(code.data(), picture);
    pixel_ += interior_count_;
    interior_count_ = b.count = b.runs = triangles_->count = 0;
}

void Gatherer::sort_fragments() {
    // One material a block; the order inside a material stays that of the pixels.
    const auto key = [](const Fragment& f) {
        return std::tuple(f.key.lit, f.key.material, f.rank);
    };
    const auto differs = [&](const Fragment& a, const Fragment& b) { return key(a) != key(b); };
    if (std::adjacent_find(fragments_.begin(), fragments_.end(), differs) != fragments_.end())
        std::stable_sort(fragments_.begin(), fragments_.end(),
                         [&](const Fragment& a, const Fragment& b) { return key(a) < key(b); });
}

// The next item, a fragment's.
void Gatherer::add_fragment(const GatherInput& in, const Fragment& f, image::Image& picture) {
    ShadingBlock& b = *block_;
    const bool own = is_set_up_per_item(in, f.id);
    const Primitive* of = b.lit && !own ? &primitive(in, f.id, picture) : nullptr; // may end it
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
        const auto [x, y] = place_in_pixel(in, *of, area_.x0 + f.pixel % kTileSize,
                                           area_.y0 + f.pixel / kTileSize, {f.at_x, f.at_y});
        add_item(b, PrimitiveCache::at(*of, x, y), x, y);
    } else {
        add_unlit(in, f.id, 1);
    }
}

std::uint64_t Gatherer::shade_fragments(const GatherInput& in, image::Image& picture) {
    ShadingBlock& b = *block_;
    if (!in.keys.only_material || b.blended != nullptr) sort_fragments();
    for (const Fragment& f : fragments_) {
        if (key_ != f.key) begin_key(in, f.key, picture);
        if (b.count == kBlockSize) finish_block(in, picture);
        add_fragment(in, f, picture);
    }
    return fragments_.size();
}

// What a row's edge pixels show first at a sample, as items. Returns how many.
int Gatherer::add_edge_items(const raster::VisibilityTile& tile, int row, int sample,
                             const EdgeRow& found, const GatherInput& in, image::Image& picture) {
    ShadingBlock& b = *block_;
    const auto s = static_cast<std::size_t>(sample);
    const int count = std::popcount(found.first[s]);
    if (count == 0) return 0;
    if (b.count + count > kBlockSize) finish_block(in, picture);
    const std::uint32_t* ids = tile.ids(sample).data() + std::ptrdiff_t{row} * kTileSize;
    const float* coverage = found.coverage[s];
    const raster::SampleOffset at = tile.pattern()[s];
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
std::uint64_t Gatherer::shade_rows(const raster::VisibilityTile& tile, const GatherInput& in,
                                   image::Image& picture) {
    if (edge_pixels_.empty()) return 0;
    const ShadingKey key = {*in.keys.only_material, true};
    if (key_ != key) begin_key(in, key, picture);
    transmittance_.resize(edge_pixels_.size());
    std::uint64_t items = 0;
    std::uint16_t index = 0;
    for (int row = 0; row < area_.height(); ++row) {
        const std::uint64_t edges = edge_bits_[static_cast<std::size_t>(row)];
        if (edges == 0) continue;
        EdgeRow found;
        find_edge_row(tile, row, edges, found);
        for (std::uint64_t rest = edges; rest != 0; rest &= rest - 1) {
            const int x = std::countr_zero(rest);
            edge_index_[static_cast<std::size_t>(x)] = index;
            transmittance_[index++] = found.transmittance[x];
        }
        for (int s = 0; s < tile.samples(); ++s)
            items += static_cast<std::uint64_t>(add_edge_items(tile, row, s, found, in, picture));
    }
    return items;
}

} // namespace scanout::shade
