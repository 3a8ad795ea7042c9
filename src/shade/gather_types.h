// What the gatherer's lists hold.
#pragma once

#include "shade/gather.h"

#include <cstdint>

namespace scanout::shade {

inline constexpr std::uint16_t kOwn = 0xffff; // all samples show this fragment, and nothing else

// One primitive in pixels of a row side by side.
struct Gatherer::Fragment {
    std::uint32_t id;
    std::int32_t material; // index, -1: the default material
    std::uint16_t pixel;   // the first, in the tile
    std::uint8_t count;    // pixels
    std::uint8_t sample;   // the first that shows it
    bool lit;              // lines and points are not
    std::uint8_t rank;     // of a pixel with blended fragments: 0 is shaded first
    std::uint16_t shared;  // place in the list of shared pixels, or kOwn
    float weight;          // its share of a shared pixel; of a composed one, the bits of its layer
    std::uint16_t samples; // of a shared pixel: bit s says that it shows at sample s
    std::uint8_t at_x, at_y; // a place that shows it, from the pixel's corner, 1/256 pixel
};

struct Gatherer::Piece {
    int lane, count; // of the block
    std::uint16_t pixel, shared;
    float weight;
    std::uint16_t samples;
};

inline std::uint8_t byte_of(std::int32_t offset) { // in a pixel: [0, 255]
    return static_cast<std::uint8_t>(offset);
}

struct Look {
    std::int32_t material;
    bool lit;
};
inline Look look_of(const geom::Mesh& mesh, std::uint32_t id) {
    const std::size_t triangles = mesh.triangles(), lines = mesh.lines();
    if (id < triangles) return {mesh.material[id], true};
    const std::size_t line = id - triangles;
    return {line < lines ? mesh.line_material[line] : mesh.point_material[line - lines], false};
}

} // namespace scanout::shade
