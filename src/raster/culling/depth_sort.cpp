#include "raster/culling/depth_sort.h"

#include <algorithm>
#include <array>
#include <bit>
#include <functional>

#define SIMD_FILE "raster/culling/depth_sort.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::raster)

// Rank sort: the position of a triangle is the number of nearer ones. Compares all pairs, side by
// side in lanes; a comparison sort of so few would lose its time to branch mispredictions.
void rank_all(const std::uint64_t* triangle, int count, std::uint64_t* out) {
    alignas(64) std::int32_t depth[kMaxRanked];
    for (int i = 0; i < kMaxRanked; ++i) // bits of floats that are not negative have their order
        depth[i] =
            i < count ? (static_cast<std::int32_t>(triangle[i] >> 32) & -kMaxRanked) | i : -1;
    for (int i = 0; i < count; ++i) {
        const I32 mine = depth[i];
        int nearer = 0;
        for (int k = 0; k < count; k += kLanes)
            nearer += __builtin_popcount(bits(load<I32>(depth + k) > mine));
        out[nearer] = triangle[i];
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(rank_all);

DepthAndId depth_and_id(float depth, std::uint32_t id) {
    return std::uint64_t{std::bit_cast<std::uint32_t>(depth)} << 32 | id;
}

void sort_front_to_back(std::vector<DepthAndId>& triangles) {
    if (triangles.size() > kMaxRanked)
        return std::sort(triangles.begin(), triangles.end(), std::greater<>());
    std::array<DepthAndId, kMaxRanked> ranked;
    SIMD_CALL(rank_all, triangles.data(), static_cast<int>(triangles.size()), ranked.data());
    std::copy_n(ranked.begin(), triangles.size(), triangles.begin());
}

} // namespace scanout::raster
#endif
