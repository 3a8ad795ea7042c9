// Texel addressing that the texture filters share: texel centres lie at half-integers, v runs up
// and rows run down (TOPICS T15), repeat or clamp, the options -o and -s of the map.
#pragma once

#include "math/srgb.h"
#include "scene/material.h"

#include <algorithm>
#include <cstdint>

namespace scanout::shade {

// floor for |x| < 2^30; larger and NaN give 0: conversions are clamped, the same on every CPU.
inline std::int32_t floor_to_int(float x) {
    const float safe = x > -0x1p30F && x < 0x1p30F ? x : 0.0F;
    const auto whole = static_cast<std::int32_t>(safe);
    return whole - (static_cast<float>(whole) > safe ? 1 : 0);
}

class TexelReader {
public:
    TexelReader(const image::Image& image, const scene::TextureMap& map)
        : image_(image), map_(map), width_(image.width()), height_(image.height()) {}

    // Texel coordinates, in texels: x right from the left edge, y up from the bottom edge.
    float x(float u) const {
        return unit(u * map_.scale.x + map_.offset.x) * static_cast<float>(width_);
    }
    float y(float v) const {
        return unit(v * map_.scale.y + map_.offset.y) * static_cast<float>(height_);
    }
    // Linear light of a texel, counted from the bottom left, addressed beyond the edges.
    void read(std::int32_t x, std::int32_t y, float out[3]) const {
        const image::Rgba8 texel = image_.at(address(x, width_), height_ - 1 - address(y, height_));
        out[0] = srgb_decode(texel.r);
        out[1] = srgb_decode(texel.g);
        out[2] = srgb_decode(texel.b);
    }

private:
    // Into [0, 1): repeats by removing whole turns first, so that large coordinates keep their
    // precision; clamps to [0, 1] where the map says so.
    float unit(float t) const {
        if (map_.clamp) return t > 0 ? (t < 1 ? t : 1.0F) : 0.0F; // NaN gives 0
        const float safe = t > -0x1p30F && t < 0x1p30F ? t : 0.0F;
        return safe - static_cast<float>(floor_to_int(safe));
    }
    std::int32_t address(std::int32_t i, std::int32_t size) const {
        if (map_.clamp) return std::clamp(i, 0, size - 1);
        return i < 0 ? i + size : (i >= size ? i - size : i);
    }

    const image::Image& image_;
    const scene::TextureMap& map_;
    std::int32_t width_, height_;
};

} // namespace scanout::shade
