// The tiles of a picture.
#pragma once

#include "image/image.h"

#include <cstddef>

namespace scanout::raster {

struct TileGrid {
    int bits;   // a tile has 1 << bits pixels a side
    int across; // tiles in a row of the picture

    // f(tile) of each tile that has some of these pixels; there is one at least.
    template <class F>
    void for_tiles(int x0, int y0, int x1, int y1, F&& f) const {
        const int first = x0 >> bits, end = ((x1 - 1) >> bits) + 1;
        for (int y = y0 >> bits; y <= (y1 - 1) >> bits; ++y)
            for (int x = first; x < end; ++x)
                f(static_cast<std::size_t>(y * across + x));
    }
    template <class F>
    void for_tiles(const image::Rect& pixels, F&& f) const {
        if (!pixels.empty()) for_tiles(pixels.x0, pixels.y0, pixels.x1, pixels.y1, f);
    }
};

} // namespace scanout::raster
