// The gatherer's third part: stores the light of a block's items. Interior pixels are encoded at
// once, edge pixels after they are summed; sums wait if a filter has yet to resolve them.
#include "image/dither.h"
#include "shade/check_lanes.h"
#include "shade/gather/gather_types.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace scanout::shade {

using raster::kTileSize;

// The dither of a pixel of the tile.
float Gatherer::offset_at(int pixel) const {
    return image::dither_offset(static_cast<unsigned>(area_.x0 + pixel % kTileSize),
                                static_cast<unsigned>(area_.y0 + pixel / kTileSize));
}

// Dither offsets of the block's items; null where nothing is dithered.
const float* Gatherer::item_offsets(const GatherInput& in) {
    if (!in.output.dither) return nullptr;
    offsets_.resize(kPaddedBlock);
    for (std::size_t item = 0; item < static_cast<std::size_t>(block_->count); ++item)
        offsets_[item] = offset_at(pixel_[item]);
    return offsets_.data();
}

// Stores the codes of interior pixels, and adds the weighted light of the others to sums_.
void Gatherer::store_pixels(const std::uint32_t* code, image::Image& picture) {
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

// Adds all items for the reconstruction filter. A blended fragment has the same weight at all
// samples that it covers.
void Gatherer::add_pixel_sums() {
    if (sink_.filter == nullptr) return add_linear(*sink_.own);
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

// Adds the block's items. Pixels that several fragments share are summed in the order of their
// blocks.
void Gatherer::add_linear(LinearPicture& linear) const {
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

// Appends the splats of the edge pixels to the tile's splats, where the filter will read them.
void Gatherer::store_splats() {
    auto& all = sink_.splats->of_tile[sink_.splats->tile_of(area_.x0, area_.y0)];
    for (std::size_t i = 0; i < edge_pixels_.size(); ++i)
        sink_.splats->splat_at(area_.x0 + edge_pixels_[i] % kTileSize,
                               area_.y0 + edge_pixels_[i] / kTileSize) =
            static_cast<std::int32_t>(all.size() + i);
    all.insert(all.end(), splats_.begin(), splats_.end());
}

} // namespace scanout::shade
