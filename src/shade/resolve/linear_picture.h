// A frame's light before it is encoded: for measuring what no eye and no 8-bit code shows. Nobody
// fills it unless asked.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace scanout::shade {

// Rows from the top. A pixel is the sum, over the samples that show a primitive, of its linear
// light and of 1, over the number of samples: red, green, blue, share covered. The background is
// not in it.
struct LinearPicture {
    int width = 0, height = 0;
    int x0 = 0, y0 = 0; // its first pixel, where it is a part of a frame
    std::vector<std::array<float, 4>> pixel;

    LinearPicture() = default;
    LinearPicture(int w, int h)
        : width(w), height(h), pixel(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
    // All is zero, the size this, and the memory what it was if that is enough.
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
