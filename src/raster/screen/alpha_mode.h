// How a tile draws the triangles of a material.
#pragma once

#include <cstdint>

namespace scanout::raster {

enum class AlphaMode : std::uint8_t {
    opaque,  // drawn into the visibility buffer
    cut_out, // each sample is drawn or not, once its alpha is known
    blended, // blends with the surfaces behind: its samples are collected
    nothing  // cannot be seen
};

} // namespace scanout::raster
