// Weighted area sampling: a pixel is a weighted mean over the samples of 3 x 3 pixels. Every pixel
// is shaded once, by its own tile; its splats to its neighbours wait in a SplatPicture until all
// tiles are done. Feibush, Levoy and Cook 1980, [Primer 6].
#pragma once

#include "raster/screen/sample_pattern.h"
#include "shade/resolve/linear_picture.h"
#include "shade/resolve/resolve.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::shade {

// Cells around a pixel, row by row from the upper left; kCells / 2 is the pixel itself.
inline constexpr std::size_t kCells = 9;

class ReconstructionFilter {
public:
    // kernel: the weight at a distance from the pixel's centre along one axis, in pixels; both axes
    // are multiplied.
    ReconstructionFilter(std::span<const raster::SampleOffset> pattern,
                         double (*kernel)(double distance));

    // The weight that the samples of the mask (bit s: sample s) add to the pixel at the opposite
    // cell: a pixel reads its right neighbour's own samples under the cell `right`. All samples of
    // all cells add up to 1.
    float weight(std::size_t cell, std::uint32_t mask) const {
        float sum = 0;
        for (std::size_t s = 0; mask != 0; ++s, mask >>= 1)
            if ((mask & 1) != 0) sum += sample_[cell][s];
        return sum;
    }
    float total_weight(std::size_t cell) const { return total_[cell]; }

private:
    std::array<std::array<float, 16>, kCells> sample_{};
    std::array<float, kCells> total_{};
};

// The splat of a pixel to each cell: red, green, blue, share.
using FilterSplat = std::array<std::array<float, 4>, kCells>;

struct SplatPicture {
    LinearPicture own;               // pixels that one fragment fills; zero where empty
    std::vector<std::int32_t> splat; // index in the tile's splat list; -1: own has the pixel
    std::vector<std::vector<FilterSplat>> of_tile;
    int tile_size = 64, tiles_across = 0;

    void reset(int width, int height, int tile, int across, int tiles);
    std::size_t bytes() const; // that hold the last picture
    std::size_t tile_of(int x, int y) const {
        return static_cast<std::size_t>(y / tile_size * tiles_across + x / tile_size);
    }
    std::int32_t& splat_at(int x, int y) {
        return splat[static_cast<std::size_t>(y) * static_cast<std::size_t>(own.width) +
                     static_cast<std::size_t>(x)];
    }
};

// Writes the weighted means of an area's pixels into sums, row by row; beyond the picture its edge
// repeats. Returns whether any of them shows a primitive.
bool filter_area(const ReconstructionFilter& filter, SplatPicture& from, const image::Rect& area,
                 PixelSums& sums);

} // namespace scanout::shade
