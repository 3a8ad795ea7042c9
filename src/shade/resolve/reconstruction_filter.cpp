#include "shade/resolve/reconstruction_filter.h"

#include "shade/check_lanes.h"

#include <algorithm>

namespace scanout::shade {

ReconstructionFilter::ReconstructionFilter(std::span<const raster::SampleOffset> pattern,
                                           double (*kernel)(double distance)) {
    const auto along = [&](std::size_t cell, std::int32_t offset) {
        const double distance = static_cast<double>(cell) - 1 + offset / 256.0 - 0.5;
        return kernel(distance < 0 ? -distance : distance);
    };
    std::array<std::array<double, 16>, kCells> exact{};
    double total = 0;
    for (std::size_t cell = 0; cell < kCells; ++cell)
        for (std::size_t s = 0; s < pattern.size(); ++s) {
            exact[cell][s] = along(cell % 3, pattern[s].x) * along(cell / 3, pattern[s].y);
            total += exact[cell][s];
        }
    const std::uint32_t all = (1u << pattern.size()) - 1;
    for (std::size_t cell = 0; cell < kCells; ++cell) {
        for (std::size_t s = 0; s < pattern.size(); ++s)
            sample_[cell][s] = static_cast<float>(exact[cell][s] / total);
        total_[cell] = weight(cell, all);
    }
}

std::size_t SplatPicture::bytes() const {
    std::size_t all = own.pixel.size() * sizeof own.pixel[0] + splat.size() * sizeof splat[0];
    for (const std::vector<FilterSplat>& splats : of_tile)
        all += splats.size() * sizeof(FilterSplat);
    return all;
}

void SplatPicture::reset(int width, int height, int tile, int across, int tiles) {
    own.reset(width, height);
    splat.assign(own.pixel.size(), -1);
    tile_size = tile;
    tiles_across = across;
    of_tile.resize(static_cast<std::size_t>(tiles));
    for (std::vector<FilterSplat>& splats : of_tile)
        splats.clear();
}

bool filter_area(const ReconstructionFilter& filter, SplatPicture& from, const image::Rect& area,
                 PixelSums& sums) {
    // The sum of weights is rounded: a pixel that primitives fill must be full.
    constexpr float kFull = 1 - 0x1p-18F;
    std::size_t i = 0;
    bool any = false;
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x, ++i) {
            std::array<float, 4> sum{};
            for (std::size_t cell = 0; cell < kCells; ++cell) {
                const int px =
                    std::clamp(x + static_cast<int>(cell % 3) - 1, 0, from.own.width - 1);
                const int py =
                    std::clamp(y + static_cast<int>(cell / 3) - 1, 0, from.own.height - 1);
                const std::int32_t splat = from.splat_at(px, py);
                const std::array<float, 4>& own = from.own.at(px, py);
                for (std::size_t c = 0; c < 4; ++c)
                    sum[c] += splat < 0 ? own[c] * filter.total_weight(cell)
                                        : from.of_tile[from.tile_of(px, py)]
                                                      [static_cast<std::size_t>(splat)][cell][c];
            }
            sums.red[i] = sum[0];
            sums.green[i] = sum[1];
            sums.blue[i] = sum[2];
            sums.transmittance[i] = sum[3] > kFull ? 0.0F : 1 - sum[3];
            any = any || sum[3] > 0;
        }
    for (const auto* channel : {&sums.red, &sums.green, &sums.blue, &sums.transmittance})
        check_values(std::span(*channel).first(i), "sum", "the reconstruction filter");
    return any;
}

} // namespace scanout::shade
