// What the gatherer's lists hold.
#pragma once

#include "shade/gather/gather.h"
#include "shade/setup/primitive_cache.h"

#include <cstdint>

namespace scanout::shade {

inline constexpr std::uint32_t kNoLayer = 0xffffffff;

// One primitive in an edge pixel.
struct Gatherer::Fragment {
    std::uint32_t id;
    ShadingKey key;
    std::uint16_t pixel;            // in the tile
    std::uint8_t sample;            // the first that shows it
    std::uint8_t rank;              // of a pixel with blended fragments: 0 is shaded first
    std::uint16_t edge_pixel;       // index in the list of edge pixels
    float weight;                   // in the pixel; 0 where `layer` says what becomes of it
    std::uint16_t samples;          // bit s says that it shows at sample s
    std::uint8_t at_x, at_y;        // a place that shows it, from the pixel's corner, 1/256 pixel
    std::uint32_t layer = kNoLayer; // of a composed pixel
};

// What a item adds to an edge pixel.
struct Gatherer::Contribution {
    std::uint16_t edge_pixel; // index in the list of edge pixels
    std::uint16_t samples;    // of the fragment
    float weight;
    std::uint32_t layer;
};

struct Gatherer::VisibleSurface {
    float depth; // at the first sample that shows it
    Fragment fragment;
};

// May its items set it up, each on its own?
inline bool Gatherer::is_set_up_per_item(const GatherInput& in, std::uint32_t id) const {
    return in.frame->per_item_setup && id < in.mesh->triangles() &&
           (all_unclipped_ || is_unclipped(primitives_->source(), id));
}

inline std::uint8_t byte_of(std::int32_t offset) { // in a pixel: [0, 255]
    return static_cast<std::uint8_t>(offset);
}

} // namespace scanout::shade
