#include "shade/gather/pixel_collector.h"

#include "shade/gather/edge_row.h"
#include "shade/transparency/transparency_pass.h"

#include <algorithm>
#include <bit>
#include <tuple>

namespace scanout::shade {

using raster::kTileSize;
using raster::VisibilityTile;

static std::uint8_t byte_of(std::int32_t offset) { // in a pixel: [0, 255]
    return static_cast<std::uint8_t>(offset);
}

void PixelCollector::begin(const image::Rect& area, int samples) {
    area_ = area;
    samples_ = samples;
    by_rows_ = spatial_indices_ = false;
    interior_pixels_.clear();
    fragments_.clear();
    edge_pixels_.clear();
}

void PixelCollector::collect_row(int row, std::uint64_t edges) {
    edge_bits_[static_cast<std::size_t>(row)] = edges;
    if (edges == 0) return;
    std::size_t index = edge_pixels_.pixel.size();
    edge_pixels_.pixel.resize(index + static_cast<std::size_t>(std::popcount(edges)));
    for (; edges != 0; edges &= edges - 1)
        edge_pixels_.pixel[index++] =
            static_cast<std::uint16_t>(row * kTileSize + std::countr_zero(edges));
}

// The samples of a pixel that show an id, a bit each.
static unsigned samples_of(const VisibilityTile& tile, int pixel, std::uint32_t id) {
    unsigned samples = 0;
    for (int s = 0; s < tile.samples(); ++s)
        samples |= static_cast<unsigned>(tile.ids(s)[static_cast<std::size_t>(pixel)] == id) << s;
    return samples;
}

// Of a row's edge pixels that do not blend.
void PixelCollector::collect_fragments(const VisibilityTile& tile, const GatherInput& in, int row,
                                       std::uint64_t edges, bool with_samples) {
    EdgeRow found;
    find_edge_row(tile, row, edges, found);
    std::array<std::uint16_t, kTileSize> index; // in edge_pixels_
    for (std::uint64_t rest = edges; rest != 0; rest &= rest - 1) {
        const int x = std::countr_zero(rest);
        index[static_cast<std::size_t>(x)] = edge_pixels_.size();
        edge_pixels_.add(static_cast<std::uint16_t>(row * kTileSize + x), found.transmittance[x]);
    }
    for (int s = 0; s < tile.samples(); ++s) {
        const raster::SampleOffset& at = tile.pattern()[static_cast<std::size_t>(s)];
        for (std::uint64_t rest = found.first[s]; rest != 0; rest &= rest - 1) {
            const int x = std::countr_zero(rest), pixel = row * kTileSize + x;
            const std::uint32_t id = tile.ids(s)[static_cast<std::size_t>(pixel)];
            const unsigned samples = with_samples ? samples_of(tile, pixel, id) : 0;
            fragments_.push_back({id, in.keys.of(id), static_cast<std::uint16_t>(pixel),
                                  static_cast<std::uint8_t>(s), 0,
                                  index[static_cast<std::size_t>(x)], found.coverage[s][x],
                                  static_cast<std::uint16_t>(samples), byte_of(at.x),
                                  byte_of(at.y)});
        }
    }
}

// The surfaces of a pixel that has blended fragments, opaque ones among them, with their weights:
// in the order in which their sum is taken where nothing blends, by the first sample that shows
// them; then by depth there, and by id.
void PixelCollector::collect_blended(const VisibilityTile& tile, const GatherInput& in,
                                     const BlendedPixels& blended, int pixel) {
    const int x = area_.x0 + column_of(pixel), y = area_.y0 + row_of(pixel);
    const float* transmittance =
        blended.transmittance.data() + blended.slot[static_cast<std::size_t>(pixel)];
    const float sample_weight = 1.0F / static_cast<float>(tile.samples());
    std::vector<VisibleSurface>& surfaces = surfaces_;
    surfaces.clear();
    float background = 0;
    const auto add = [&](std::uint32_t id, int sample, float depth, float weight, unsigned mask) {
        const raster::SampleOffset& at = tile.pattern()[static_cast<std::size_t>(sample)];
        surfaces.push_back({depth,
                            {id, in.keys.of(id), static_cast<std::uint16_t>(pixel),
                             static_cast<std::uint8_t>(sample), 0, edge_pixels_.size(), weight,
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
    edge_pixels_.add(static_cast<std::uint16_t>(pixel), background);
}

// A pixel whose layers' colours decide what shows of that which lies behind: each layer is shaded
// once, as a fragment with a place of its own in place of a weight.
void PixelCollector::collect_layers(const VisibilityTile& tile, const GatherInput& in,
                                    const BlendedPixels& blended, int pixel) {
    ColourBlend& layers = *blended.colour_blend;
    const std::uint16_t number = static_cast<std::uint16_t>(pixel),
                        edge_pixel = edge_pixels_.size();
    const auto add = [&](std::uint32_t id, unsigned mask, std::uint32_t layer) {
        const int first = std::countr_zero(mask);
        const raster::SampleOffset& at = tile.pattern()[static_cast<std::size_t>(first)];
        fragments_.push_back({id, in.keys.of(id), number, static_cast<std::uint8_t>(first), 0,
                              edge_pixel, 0, static_cast<std::uint16_t>(mask), byte_of(at.x),
                              byte_of(at.y), layer});
    };
    std::array<std::uint32_t, 16> opaque_base{};
    const int samples = tile.samples();
    for (int s = 0; s < samples; ++s) {
        const std::uint32_t id = tile.ids(s)[number];
        const unsigned mask = samples_of(tile, pixel, id);
        const auto first = static_cast<std::size_t>(std::countr_zero(mask));
        std::uint32_t& layer = opaque_base[static_cast<std::size_t>(s)];
        if (id == raster::kNoPrimitive)
            layer = ColourBlend::kNothing;
        else if (first < static_cast<std::size_t>(s))
            layer = opaque_base[first];
        else
            add(id, mask, layer = layers.add_opaque_layer());
    }
    for (const std::uint32_t i : blended.fragments(pixel)) {
        const BlendFragment& f = blended.list.fragments[i];
        if (f.visible != 0) add(f.id, f.visible, i);
    }
    edge_pixels_.add(number, 0); // known when all is shaded
    layers.add_pixel(number, edge_pixel, blended.slot[number],
                     std::span(opaque_base).first(static_cast<std::size_t>(samples)));
}

// The columns of a part of a tile.
static std::uint64_t columns_of(const image::Rect& region) {
    const auto before = [](int x) { return x < kTileSize ? (std::uint64_t{1} << x) - 1 : ~0ULL; };
    return before(region.x1) & ~before(region.x0);
}

// Of a tile: below this mean length of its runs, pixels are not grouped by triangle. Grouping would
// take longer than the set-ups that it saves: 8 % of the instructions of a frame of the dragon, 3 %
// of Stanford's bunny, 960 x 540.
constexpr int kMinRunLength = 2;

// Takes a tile that shows nothing but small triangles, with one sample a pixel. Buys 7 % of a frame
// of the bunny with Blinn-Phong, on targets that pack lanes by one instruction.
bool PixelCollector::collect_small_triangles(const VisibilityTile& tile, const GatherInput& in) {
    const std::vector<raster::BinnedList>* lists = tile.small_lists_alone();
    spatial_indices_ =
        lists != nullptr && tile.samples() == 1 && all_unclipped_ && in.keys.only_material &&
        interior_pixels_.take_small_triangles(*in.keys.only_material, *lists, tile.ids(0).data(),
                                              area_.width() * area_.height());
    return spatial_indices_;
}

void PixelCollector::collect(const VisibilityTile& tile, const GatherInput& in,
                             const BlendedPixels* blended, bool with_samples) {
    begin(tile.area(), tile.samples());
    all_unclipped_ = in.frame->per_item_setup && in.geometry->all_unclipped();
    if (blended == nullptr && collect_small_triangles(tile, in)) return;
    const image::Rect& in_picture = blended != nullptr ? blended->region : area_;
    const image::Rect region = {in_picture.x0 - area_.x0, in_picture.y0 - area_.y0,
                                in_picture.x1 - area_.x0, in_picture.y1 - area_.y0};
    TileRows rows;
    find_runs(tile, region.y0, region.y1, rows);
    const auto blends = [&](int row) {
        return blended != nullptr ? blended->rows[static_cast<std::size_t>(row)] : 0;
    };
    for (int row = region.y0; row < region.y1; ++row)
        rows[static_cast<std::size_t>(row)].edge |= blends(row);
    const std::uint64_t inside = columns_of(region);
    InteriorPixels interior;
    find_interior(rows, region.y0, region.y1, inside, interior);
    const bool ungrouped =
        in.keys.only_material && all_unclipped_ && interior.count < kMinRunLength * interior.runs;
    by_rows_ = in.keys.only_material && all_unclipped_ && blended == nullptr && !with_samples;
    if (!ungrouped) interior_pixels_.add_rows(tile.ids(0).data(), interior, region.y0, region.y1);
    for (int y = region.y0; y < region.y1; ++y) {
        const auto row = static_cast<std::size_t>(y);
        if (ungrouped)
            interior_pixels_.add_ungrouped(*in.keys.only_material,
                                           tile.ids(0).data() + row * kTileSize, y * kTileSize,
                                           interior.pixels[row]);
        const std::uint64_t edges = rows[row].edge & inside, opaque = edges & ~blends(y);
        if (by_rows_) {
            collect_row(y, edges);
            continue;
        }
        if (opaque != 0) collect_fragments(tile, in, y, opaque, with_samples);
        for (std::uint64_t rest = edges & ~opaque; rest != 0; rest &= rest - 1) {
            const int pixel = y * kTileSize + std::countr_zero(rest);
            if (blended->colour_blend != nullptr)
                collect_layers(tile, in, *blended, pixel);
            else
                collect_blended(tile, in, *blended, pixel);
        }
    }
}

void PixelCollector::collect(raster::AreaTile& tile, const GatherInput& in) {
    begin(tile.area(), 1);
    std::uint32_t id = raster::kNoPrimitive; // of a run of interior pixels
    int first = 0, count = 0;
    const auto end_run = [&] {
        if (count > 0) interior_pixels_.add(id, first, count);
        count = 0;
    };
    for (int y = area_.y0; y < area_.y1; ++y, end_run())
        for (int x = area_.x0; x < area_.x1; ++x) {
            const auto found = tile.fragments(x, y);
            const bool interior =
                !found.empty() && found[0].coverage == 1.0F; // then it is the only one
            if (!interior || found[0].id != id) end_run();
            if (found.empty()) continue;
            const auto pixel =
                static_cast<std::uint16_t>((y - area_.y0) * kTileSize + (x - area_.x0));
            if (interior) {
                id = found[0].id;
                if (count++ == 0) first = pixel;
                continue;
            }
            float covered = 0;
            for (const raster::AreaFragment& f : found) {
                fragments_.push_back({f.id, in.keys.of(f.id), pixel, 0, 0, edge_pixels_.size(),
                                      f.coverage, 0, byte_of(f.x), byte_of(f.y)});
                covered += f.coverage;
            }
            edge_pixels_.add(pixel, covered > 1 - 0x1p-20F ? 0.0F : 1 - covered);
        }
}

} // namespace scanout::shade
