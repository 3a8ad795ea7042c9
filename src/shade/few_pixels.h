// The pixels of a tile that are filled by triangles with few of them: a list, and of which triangle
// each is.
#pragma once

#include "raster/coverage.h"
#include "shade/spans.h"
#include "shade/stage.h"

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace scanout::shade {

class FewPixels {
public:
    static constexpr int kMost = 24; // of a triangle: more are cheaper in registers of their own

    FewPixels();
    void clear();
    // The pixels of a group, which is one triangle's.
    void add(const Spans& spans, const Spans::Group& group) {
        spans.put_pixels(group, pixel_.data() + size_, triangle_.data() + size_,
                         static_cast<std::int32_t>(triangles_));
        id_[triangles_++] = group.id;
        if (parts_.empty() || parts_.back().material != group.look.material)
            parts_.push_back({group.look.material, size_, 0});
        size_ += group.count;
        parts_.back().end = size_;
    }

    // Those pixels of a row whose bit is set, `first` and those after it; pixels side by side may
    // show the same triangle.
    void add_row(std::int32_t material, const std::uint32_t* id, int first, std::uint64_t pixels) {
        if (pixels == 0) return;
        if (parts_.empty()) parts_.push_back({material, size_, 0});
        std::size_t triangle = triangles_, size = size_;
        std::uint32_t last = id[std::countr_zero(pixels)];
        for (; pixels != 0; pixels &= pixels - 1, ++size) {
            const int x = std::countr_zero(pixels);
            triangle += id[x] != last ? 1 : 0;
            last = id[x];
            pixel_[size] = first + x;
            triangle_[size] = static_cast<std::int32_t>(triangle);
            id_[triangle] = last;
        }
        triangles_ = triangle + 1;
        parts_.back().end = size_ = size;
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
    // Of a pixel: its triangle; from pixel to pixel of a part the same or the next one.
    const std::int32_t* triangles() const { return triangle_.data(); }
    const std::uint32_t* ids() const { return id_.data(); } // of triangles

private:
    static constexpr std::size_t kPixels = std::size_t{raster::kTileSize} * raster::kTileSize;
    std::size_t size_ = 0, triangles_ = 0;
    std::vector<std::int32_t> pixel_, triangle_;
    std::vector<std::uint32_t> id_;
    std::vector<Part> parts_;
};

} // namespace scanout::shade
