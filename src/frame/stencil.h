// The stencil buffer: a byte a pixel in which a frame marks what it draws, apart from colour and
// depth; and the techniques of axis `stencil` that draw a picture from the marks [Primer 1.6]. The
// buffer exists only while a plan uses it. Shadow volumes count at samples, in counts of their own
// (shade/shadow/shadow_count.h).
#pragma once

#include "base/technique.h"
#include "image/image.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace scanout::frame {

class StencilBuffer {
public:
    StencilBuffer(int width, int height) { reset(width, height); }
    // All pixels are 0.
    void reset(int width, int height) {
        width_ = width;
        mark_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
    }

    int width() const { return width_; }
    int height() const { return static_cast<int>(mark_.size()) / width_; }
    std::uint64_t bytes() const { return mark_.size(); }
    std::span<std::uint8_t> row(int y) {
        return std::span(mark_).subspan(start(y), static_cast<std::size_t>(width_));
    }
    std::span<const std::uint8_t> row(int y) const {
        return std::span(mark_).subspan(start(y), static_cast<std::size_t>(width_));
    }

private:
    std::size_t start(int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_);
    }
    int width_ = 0;
    std::vector<std::uint8_t> mark_;
};

struct Stencil {
    enum class Marks : std::uint8_t {
        nothing,
        visible, // 1 where some sample of the pixel shows the model
        covering // number of primitives over the pixel's centre, at most 255
    };
    Technique card;
    Marks marks = Marks::nothing;
    // Draws a row of the picture by its marks and its neighbours'.
    void (*show)(const StencilBuffer& marks, int y, image::Image& picture) = nullptr;
};

inline constexpr int kOutlineWidth = 2; // pixels

} // namespace scanout::frame
