// The gatherer's first part: what a tile shows in its interior pixels, and in its edge pixels,
// those in which several primitives are visible, or one and the background.
#include "base/check.h"
#include "shade/gather/gather_types.h"
#include "shade/transparency/transparency_pass.h"

#include <algorithm>
#include <array>
#include <bit>
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

void Gatherer::collect_edge_row(int row, std::uint64_t edges) {
    edge_bits_[static_cast<std::size_t>(row)] = edges;
    if (edges == 0) return;
    std::size_t index = edge_pixels_.size();
    edge_pixels_.resize(index + static_cast<std::size_t>(std::popcount(edges)));
    for (; edges != 0; edges &= edges - 1)
        edge_pixels_[index++] =
            static_cast<std::uint16_t>(row * kTileSize + std::countr_zero(edges));
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

// Of a tile: below this mean length of its runs, pixels are not grouped by triangle. Grouping would
// take longer than the set-ups that it saves.
constexpr int kMinRunLength = 2;

// Takes a tile that shows nothing but small triangles, with one sample a pixel. Buys 7 % of a frame
// of the bunny with Blinn-Phong, on targets that pack lanes by one instruction.
bool Gatherer::collect_small_triangles(const raster::VisibilityTile& tile, const GatherInput& in) {
    const std::vector<raster::BinnedList>* lists = tile.small_lists_alone();
    if (lists == nullptr || tile.samples() > 1 || !all_unclipped_ || !in.keys.only_material ||
        !interior_pixels_->take_small_triangles(*in.keys.only_material, *lists, tile.ids(0).data(),
                                                area_.width() * area_.height()))
        return false;
    item_source_.spatial_index = nullptr; // ids() are spatial indices
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
    const bool ungrouped =
        in.keys.only_material && all_unclipped_ && interior.count < kMinRunLength * interior.runs;
    by_rows_ = in.keys.only_material && all_unclipped_ && blended == nullptr &&
               sink_.filter == nullptr; // which asks what samples a fragment shows at
    if (!ungrouped) interior_pixels_->add_rows(tile.ids(0).data(), interior, region.y0, region.y1);
    for (int y = region.y0; y < region.y1; ++y) {
        const auto row = static_cast<std::size_t>(y);
        if (ungrouped)
            interior_pixels_->add_ungrouped(*in.keys.only_material,
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
                !found.empty() && found[0].coverage == 1.0F; // then it is the only one
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
                                      static_cast<std::uint16_t>(edge_pixels_.size()), f.coverage,
                                      0, byte_of(f.x), byte_of(f.y)});
                covered += f.coverage;
            }
            edge_pixels_.push_back(pixel);
            transmittance_.push_back(covered > 1 - 0x1p-20F ? 0.0F : 1 - covered);
        }
}

} // namespace scanout::shade
