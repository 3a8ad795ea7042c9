// The pixels of a tile that are filled by triangles with few of them: a list, one triangle a pixel.
#pragma once

#include "raster/coverage.h"
#include "shade/stage.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::shade {

class FewPixels {
public:
    static constexpr int kMost = 6; // of a triangle: more are cheaper with one set-up for all

    FewPixels();
    void clear();
    // Pixels of one triangle. Returns where their numbers in the tile go, and a few more may be
    // written behind them; each pixel once at most.
    std::int32_t* add(std::int32_t material, std::uint32_t id, int count) {
        std::int32_t* const pixels = pixel_.data() + size_;
        std::fill_n(id_.data() + size_, count, id);
        if (parts_.empty() || parts_.back().material != material)
            parts_.push_back({material, size_, 0});
        size_ += static_cast<std::size_t>(count);
        parts_.back().end = size_;
        return pixels;
    }

    // Those pixels of a row whose bit is set, `first` and those after it, each with its own
    // triangle.
    void add_row(std::int32_t material, const std::uint32_t* id, int first, std::uint64_t pixels) {
        if (pixels == 0) return;
        if (parts_.empty()) parts_.push_back({material, size_, 0});
        for (; pixels != 0; pixels &= pixels - 1) {
            const int x = std::countr_zero(pixels);
            pixel_[size_] = first + x;
            id_[size_++] = id[x];
        }
        parts_.back().end = size_;
    }

    // Materials one after the other. add() may not follow.
    void arrange();
    struct Part {
        std::int32_t material;
        std::size_t first, end;
    };
    std::span<const Part> parts() const { return parts_; }
    std::size_t size() const { return size_; } // pixels
    const std::int32_t* pixels() const { return pixel_.data(); }
    const std::uint32_t* ids() const { return id_.data(); }

private:
    static constexpr std::size_t kPixels = std::size_t{raster::kTileSize} * raster::kTileSize;
    std::size_t size_ = 0;
    std::vector<std::int32_t> pixel_;
    std::vector<std::uint32_t> id_;
    std::vector<Part> parts_;
};

} // namespace scanout::shade
