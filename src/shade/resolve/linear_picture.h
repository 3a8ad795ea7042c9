// A frame's light before it is encoded, for measurements finer than the eye and 8-bit codes. Filled
// only on request.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace scanout::shade {

// Rows from the top. A pixel is the sum of the linear light of its samples that show a primitive,
// and of 1 for each, over the number of samples: red, green, blue, share covered. Without the
// background.
struct LinearPicture {
    int width = 0, height = 0;
    int x0 = 0, y0 = 0; // its first pixel, where it is a part of a frame
    std::vector<std::array<float, 4>> pixel;

    LinearPicture() = default;
    LinearPicture(int w, int h)
        : width(w), height(h), pixel(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    // Sets the size, and all values to 0; keeps its memory if that is enough.
    void reset(int w, int h) {
        width = w;
        height = h;
        pixel.assign(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), {});
    }
    std::array<float, 4>& at(int x, int y) {
        return pixel[static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x - x0)];
    }
    friend bool operator==(const LinearPicture&, const LinearPicture&) = default;
};

} // namespace scanout::shade
