#include "shade/gather/pixel_sink.h"

#include "shade/check_lanes.h"
#include "shade/gather/block_pixels.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace scanout::shade {

// Edge pixels are summed in the order of their blocks.
void add_linear(LinearPicture& sums, const image::Rect& tile, const ShadedItems& items) {
    for (int item = 0; item < items.block.count; ++item) {
        const int pixel = items.pixel[item];
        const float weight = item < items.interior ? 1 : items.contribution[item].weight;
        CoveredLight& sum = sums.at(tile.x0 + column_of(pixel), tile.y0 + row_of(pixel));
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += items.block.colour[c][item] * weight;
        sum[3] += weight;
    }
}

void add_mean(CoveredLight& sum, std::span<const CoveredLight> samples) {
    const float each = 1.0F / static_cast<float>(samples.size());
    CoveredLight mean{};
    for (const CoveredLight& sample : samples)
        for (std::size_t c = 0; c < 4; ++c)
            mean[c] += sample[c] * each;
    for (std::size_t c = 0; c < 4; ++c)
        sum[c] += mean[c];
}

void PictureSink::begin(const Tile& tile) {
    static_assert(sizeof(image::Rgba8) == sizeof(std::uint32_t));
    sums_.reset(tile.edge_pixels.size());
}

void PictureSink::store(const Tile& tile, const ShadedItems& items) {
    store_codes(items.code, items.pixel, items.interior, &picture_->at(tile.area.x0, tile.area.y0),
                picture_->width());
    const ShadingBlock& b = items.block;
    float *const red = sums_.red.data(), *const green = sums_.green.data(),
                 *const blue = sums_.blue.data();
    for (int item = items.interior, end = b.count; item < end; ++item) {
        const std::uint16_t edge_pixel = items.contribution[item].edge_pixel;
        const float weight = items.contribution[item].weight;
        red[edge_pixel] += b.colour[0][item] * weight;
        green[edge_pixel] += b.colour[1][item] * weight;
        blue[edge_pixel] += b.colour[2][item] * weight;
    }
}

void PictureSink::store_layers(const Tile& tile, const ColourBlend::Pixel& pixel,
                               std::span<const CoveredLight> samples) {
    CoveredLight mean{};
    add_mean(mean, samples);
    sums_.red[pixel.edge_pixel] = mean[0];
    sums_.green[pixel.edge_pixel] = mean[1];
    sums_.blue[pixel.edge_pixel] = mean[2];
    tile.edge_pixels.transmittance[pixel.edge_pixel] = 1 - mean[3];
}

// Resolves the edge pixels.
void PictureSink::end(const Tile& tile) {
    const EdgePixels& edges = tile.edge_pixels;
    const std::size_t count = edges.pixel.size();
    if (count == 0) return;
    check_sums(sums_, count);
    codes_.resize(count + (kPaddedBlock - kBlockSize));
    std::copy(edges.transmittance.begin(), edges.transmittance.end(), sums_.transmittance.begin());
    const bool dithers = tile.output.dither;
    if (dithers) {
        offsets_.resize(count + (kPaddedBlock - kBlockSize));
        for (std::size_t i = 0; i < count; ++i)
            offsets_[i] = dither_at(tile.area, edges.pixel[i]);
    }
    resolve_pixels(sums_, tile.output, tile.background, dithers ? offsets_.data() : nullptr,
                   static_cast<int>(count), codes_.data());
    for (std::size_t i = 0; i < count; ++i) {
        const int x = tile.area.x0 + column_of(edges.pixel[i]);
        const int y = tile.area.y0 + row_of(edges.pixel[i]);
        std::memcpy(static_cast<void*>(&picture_->at(x, y)), &codes_[i], sizeof codes_[i]);
    }
}

void SumSink::store(const Tile& tile, const ShadedItems& items) {
    add_linear(*sums_, tile.area, items);
}

void SumSink::store_layers(const Tile& tile, const ColourBlend::Pixel& pixel,
                           std::span<const CoveredLight> samples) {
    add_mean(sums_->at(tile.area.x0 + column_of(pixel.number), tile.area.y0 + row_of(pixel.number)),
             samples);
}

void SplatSink::begin(const Tile& tile) {
    splats_.assign(tile.edge_pixels.size(), {});
}

// A blended fragment has the same weight at all samples that it covers.
void SplatSink::store(const Tile& tile, const ShadedItems& items) {
    const ShadingBlock& b = items.block;
    for (int item = 0; item < items.interior; ++item) {
        const int pixel = items.pixel[item];
        picture_->own.at(tile.area.x0 + column_of(pixel), tile.area.y0 + row_of(pixel)) = {
            b.colour[0][item], b.colour[1][item], b.colour[2][item], 1.0F};
    }
    for (int item = items.interior; item < b.count; ++item) {
        const auto& [edge_pixel, samples, weight, layer] = items.contribution[item];
        // 1 where it is opaque.
        const float each =
            weight * static_cast<float>(tile.samples) / static_cast<float>(std::popcount(samples));
        for (std::size_t cell = 0; cell < kCells; ++cell) {
            const float cell_weight = filter_->weight(cell, samples) * each;
            CoveredLight& splat = splats_[edge_pixel][cell];
            for (std::size_t c = 0; c < 3; ++c)
                splat[c] += b.colour[c][item] * cell_weight;
            splat[3] += cell_weight;
        }
    }
}

void SplatSink::store_layers(const Tile&, const ColourBlend::Pixel& pixel,
                             std::span<const CoveredLight> samples) {
    for (std::size_t s = 0; s < samples.size(); ++s)
        for (std::size_t cell = 0; cell < kCells; ++cell) {
            const float weight = filter_->weight(cell, 1U << s);
            for (std::size_t c = 0; c < 4; ++c)
                splats_[pixel.edge_pixel][cell][c] += samples[s][c] * weight;
        }
}

// Appends the splats of the edge pixels to those of the tile, where the filter will read them.
void SplatSink::end(const Tile& tile) {
    auto& all = picture_->of_tile[picture_->tile_of(tile.area.x0, tile.area.y0)];
    for (std::size_t i = 0; i < splats_.size(); ++i) {
        const int pixel = tile.edge_pixels.pixel[i];
        picture_->splat_at(tile.area.x0 + column_of(pixel), tile.area.y0 + row_of(pixel)) =
            static_cast<std::int32_t>(all.size() + i);
    }
    all.insert(all.end(), splats_.begin(), splats_.end());
}

} // namespace scanout::shade
