// An 8-bit RGBA picture in memory: sRGB codes, rows from the top, no padding.
#pragma once

#include "base/large_array.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace scanout::image {

struct Rgba8 {
    std::uint8_t r = 0, g = 0, b = 0, a = 255;
    friend bool operator==(const Rgba8&, const Rgba8&) = default;
};
static_assert(sizeof(Rgba8) == 4);

class Image {
public:
    Image() = default;
    Image(int width, int height, Rgba8 fill = {}) : Image(unwritten(width, height)) {
        std::fill(pixels_.begin(), pixels_.end(), fill);
    }
    // Its pixels are anything until they are written.
    static Image unwritten(int width, int height) {
        Image image;
        image.width_ = width;
        image.height_ = height;
        image.pixels_ = LargeArray<Rgba8>(image.offset(height));
        return image;
    }

    int width() const { return width_; }
    int height() const { return height_; }
    bool empty() const { return pixels_.empty(); }

    std::span<Rgba8> row(int y) {
        return {pixels_.data() + offset(y), static_cast<std::size_t>(width_)};
    }
    std::span<const Rgba8> row(int y) const {
        return {pixels_.data() + offset(y), static_cast<std::size_t>(width_)};
    }
    Rgba8& at(int x, int y) { return pixels_[offset(y) + static_cast<std::size_t>(x)]; }
    const Rgba8& at(int x, int y) const { return pixels_[offset(y) + static_cast<std::size_t>(x)]; }
    std::span<const Rgba8> pixels() const { return {pixels_.data(), pixels_.size()}; }
    std::span<Rgba8> pixels() { return {pixels_.data(), pixels_.size()}; }

    friend bool operator==(const Image&, const Image&) = default;

private:
    std::size_t offset(int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
    }
    int width_ = 0, height_ = 0;
    LargeArray<Rgba8> pixels_;
};

// A half-open rectangle of pixels, x right, y down.
struct Rect {
    int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
    bool empty() const { return x1 <= x0 || y1 <= y0; }
    friend bool operator==(const Rect&, const Rect&) = default;
};

} // namespace scanout::image
