// How the triangles of a material come into a tile.
#pragma once

#include <cstdint>

namespace scanout::raster {

enum class AlphaMode : std::uint8_t {
    opaque,  // drawn into the visibility buffer
    cut_out, // each sample is drawn or not, once its alpha is known
    blended, // lets through what lies behind: its samples are collected
    nothing  // cannot be seen
};

} // namespace scanout::raster
