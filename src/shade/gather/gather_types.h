// What goes between the parts of the gatherer: edge pixels, and what adds to them.
#pragma once

#include "image/dither.h"
#include "image/image.h"
#include "raster/tile/tile.h"
#include "shade/gather/shading_key.h"

#include <cstdint>
#include <vector>

namespace scanout::shade {

inline constexpr std::uint32_t kNoLayer = 0xffffffff;

// One primitive in an edge pixel.
struct EdgeFragment {
    std::uint32_t id;
    ShadingKey key;
    std::uint16_t pixel;            // in the tile
    std::uint8_t sample;            // the first that shows it
    std::uint8_t rank;              // of a pixel with blended fragments: 0 is shaded first
    std::uint16_t edge_pixel;       // index in EdgePixels
    float weight;                   // in the pixel; 0 where `layer` says what becomes of it
    std::uint16_t samples;          // bit s says that it shows at sample s, where a sink wants that
    std::uint8_t at_x, at_y;        // a place that shows it, from the pixel's corner, 1/256 pixel
    std::uint32_t layer = kNoLayer; // of a pixel whose layers' colours decide
};

// What an item adds to an edge pixel.
struct Contribution {
    std::uint16_t edge_pixel; // index in EdgePixels
    std::uint16_t samples;    // of the fragment
    float weight;
    std::uint32_t layer;
};

// The edge pixels of a tile, in the order in which they are found.
struct EdgePixels {
    std::vector<std::uint16_t> pixel;
    std::vector<float> transmittance; // of each: the weight of the background

    void clear() {
        pixel.clear();
        transmittance.clear();
    }
    void add(std::uint16_t number, float background) {
        pixel.push_back(number);
        transmittance.push_back(background);
    }
    std::uint16_t size() const { return static_cast<std::uint16_t>(pixel.size()); }
};

// A pixel of a tile by its number there.
inline int column_of(int pixel) {
    return pixel % raster::kTileSize;
}
inline int row_of(int pixel) {
    return pixel / raster::kTileSize;
}
inline float dither_at(const image::Rect& tile, int pixel) {
    return image::dither_offset(static_cast<unsigned>(tile.x0 + column_of(pixel)),
                                static_cast<unsigned>(tile.y0 + row_of(pixel)));
}

} // namespace scanout::shade
