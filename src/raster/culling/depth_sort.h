// Depth sort of a tile's large triangles, front to back, so that the first ones occlude those drawn
// later. No picture depends on the order.
#pragma once

#include <cstdint>
#include <vector>

namespace scanout::raster {

// A triangle and its nearest depth, which is not negative.
using DepthAndId = std::uint64_t;
DepthAndId depth_and_id(float depth, std::uint32_t id);
inline std::uint32_t id_of(DepthAndId of) {
    return static_cast<std::uint32_t>(of);
}

// Front to back; depths that differ by less than 2^-16 of themselves come in any order. A tile has
// a few dozen: up to kMaxRanked are ranked, more are sorted. Sorting all took 2 % of a building
// more.
inline constexpr int kMaxRanked = 64;
void sort_front_to_back(std::vector<DepthAndId>& triangles);

} // namespace scanout::raster
