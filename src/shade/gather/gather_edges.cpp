// The gatherer's part in edge pixels: those in which several primitives are visible, or one and the
// background.
#include "base/check.h"
#include "shade/check_lanes.h"
#include "shade/gather/gather_types.h"
#include "shade/setup/primitive_cache.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <tuple>
#include <utility>

namespace scanout::shade {

using raster::kTileSize;

// Of the samples in id, which of them show what the first of `rest` shows, and how many.
template <int kSamples>
static std::pair<unsigned, int> like_first(const std::array<std::uint32_t, 16>& id, unsigned rest) {
    const std::uint32_t here = id[static_cast<std::size_t>(std::countr_zero(rest))];
    unsigned mask = 0;
    int count = 0; // faster than std::popcount, a call on the oldest x86
#pragma GCC unroll 16
    for (std::size_t s = 0; s < kSamples; ++s) {
        const bool same = id[s] == here;
        mask |= static_cast<unsigned>(same) << s;
        count += same ? 1 : 0;
    }
    return {mask, count};
}

template <int kSamples>
void Gatherer::collect_samples(const raster::VisibilityTile& tile, const GatherInput& in,
                               std::uint16_t pixel) {
    const std::uint32_t* ids = tile.ids(0).data() + pixel;
    std::array<std::uint32_t, 16> id;
#pragma GCC unroll 16
    for (std::size_t s = 0; s < kSamples; ++s)
        id[s] = ids[s * raster::VisibilityTile::kPlane];
    float background = 0;
    const auto edge_pixel = static_cast<std::uint16_t>(edge_pixels_.size());
    // From sample to sample that shows what none before it has shown.
    for (unsigned rest = (1U << kSamples) - 1; rest != 0;) {
        const int first = std::countr_zero(rest);
        const auto [mask, count] = like_first<kSamples>(id, rest);
        rest &= ~mask;
        const std::uint32_t here = id[static_cast<std::size_t>(first)];
        const float weight = static_cast<float>(count) * (1.0F / kSamples);
        if (here == raster::kNoPrimitive) {
            background = weight;
            continue;
        }
        const raster::SampleOffset& at = tile.pattern()[static_cast<std::size_t>(first)];
        fragments_.push_back({here, in.keys.of(here), pixel, static_cast<std::uint8_t>(first), 0,
                              edge_pixel, weight, static_cast<std::uint16_t>(mask), byte_of(at.x),
                              byte_of(at.y)});
    }
    edge_pixels_.push_back(pixel);
    transmittance_.push_back(background);
}

void Gatherer::collect_edge_pixel(const raster::VisibilityTile& tile, const GatherInput& in, int x,
                                  int y) {
    const std::uint16_t pixel = pixel_number(x, y);
    switch (tile.samples()) {
    case 2:
        return collect_samples<2>(tile, in, pixel);
    case 4:
        return collect_samples<4>(tile, in, pixel);
    case 8:
        return collect_samples<8>(tile, in, pixel);
    default:
        CHECK_EQ(tile.samples(), 16);
        return collect_samples<16>(tile, in, pixel);
    }
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

void Gatherer::collect_edge_row(int row, std::uint64_t edges) {
    edge_bits_[static_cast<std::size_t>(row)] = edges;
    if (edges == 0) return;
    std::size_t index = edge_pixels_.size();
    edge_pixels_.resize(index + static_cast<std::size_t>(std::popcount(edges)));
    for (; edges != 0; edges &= edges - 1)
        edge_pixels_[index++] =
            static_cast<std::uint16_t>(row * kTileSize + std::countr_zero(edges));
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

void Gatherer::resolve_edge_pixels(const GatherInput& in, image::Image& picture) {
    check_sums(sums_, edge_pixels_.size());
    codes_.resize(edge_pixels_.size() + (kPaddedBlock - kBlockSize));
    std::copy(transmittance_.begin(), transmittance_.end(), sums_.transmittance.begin());
    if (in.output.dither) {
        offsets_.resize(edge_pixels_.size() + (kPaddedBlock - kBlockSize));
        for (std::size_t i = 0; i < edge_pixels_.size(); ++i)
            offsets_[i] = offset_at(edge_pixels_[i]);
    }
    resolve_pixels(sums_, in.output, in.background, in.output.dither ? offsets_.data() : nullptr,
                   static_cast<int>(edge_pixels_.size()), codes_.data());
    for (std::size_t i = 0; i < edge_pixels_.size(); ++i) {
        const int x = area_.x0 + edge_pixels_[i] % kTileSize;
        const int y = area_.y0 + edge_pixels_[i] / kTileSize;
        std::memcpy(static_cast<void*>(&picture.at(x, y)), &codes_[i], sizeof codes_[i]);
    }
}

// The edge pixels' parts go where the filter will look for them, behind those of other parts of the
// tile.
void Gatherer::store_splats() {
    auto& all = sink_.splats->of_tile[sink_.splats->tile_of(area_.x0, area_.y0)];
    for (std::size_t i = 0; i < edge_pixels_.size(); ++i)
        sink_.splats->splat_at(area_.x0 + edge_pixels_[i] % kTileSize,
                               area_.y0 + edge_pixels_[i] / kTileSize) =
            static_cast<std::int32_t>(all.size() + i);
    all.insert(all.end(), splats_.begin(), splats_.end());
}

} // namespace scanout::shade
