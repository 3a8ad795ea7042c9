// The order in which a tile draws its large triangles: those that are drawn hide what comes after
// them. What is shown does not depend on it.
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

// The nearest first; depths that differ by less than 2^-16 of themselves in any order. A tile has a
// few dozen: up to kMostRanked are ranked, more are sorted.
inline constexpr int kMostRanked = 64;
void put_nearest_first(std::vector<DepthAndId>& triangles);

} // namespace scanout::raster
