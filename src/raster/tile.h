// A tile's visibility buffer: at every sample the greatest depth and the primitive it belongs to,
// at a tie the lower id. The choice is commutative, so primitives may be drawn in any order.
#pragma once

#include "raster/primitive.h"
#include "raster/sample_pattern.h"

#include <cstdint>
#include <span>
#include <vector>

namespace scanout::raster {

inline constexpr int kTileSize = 64;

class VisibilityTile {
public:
    // Makes the tile empty: `area` is at most kTileSize on a side.
    void reset(const image::Rect& area, int samples);

    void draw(const Triangle& triangle);
    void draw(const Segment& segment);
    void draw(const Point& point);

    const image::Rect& area() const { return area_; }
    int samples() const { return samples_; }
    std::span<const SampleOffset> pattern() const { return pattern_; }
    bool empty() const { return !touched_; }

    // x, y: a pixel of the picture inside area().
    std::uint32_t id(int x, int y, int sample = 0) const {
        return id_[offset(x, y) + static_cast<std::size_t>(sample)];
    }
    float depth(int x, int y, int sample = 0) const {
        return depth_[offset(x, y) + static_cast<std::size_t>(sample)];
    }

private:
    std::size_t count() const { return static_cast<std::size_t>(samples_); }
    std::size_t offset(int x, int y) const {
        return static_cast<std::size_t>((y - area_.y0) * kTileSize + (x - area_.x0)) * count();
    }
    image::Rect inside(const image::Rect& bounds) const;
    // Shows the primitive at one sample if it is the nearest there.
    void put(std::size_t sample, float depth, std::uint32_t id) {
        if (depth > depth_[sample] || (depth == depth_[sample] && id < id_[sample])) {
            depth_[sample] = depth;
            id_[sample] = id;
            touched_ = true;
        }
    }
    void put_pixel(int x, int y, float depth, std::uint32_t id);

    image::Rect area_;
    int samples_ = 1;
    std::span<const SampleOffset> pattern_;
    SampleExtent extent_;
    bool touched_ = false;
    std::vector<float> depth_;
    std::vector<std::uint32_t> id_;
};

} // namespace scanout::raster
