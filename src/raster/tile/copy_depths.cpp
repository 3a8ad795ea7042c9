#include "raster/tile/copy_depths.h"

#include <algorithm>
#include <cstdint>

#define SIMD_FILE "raster/tile/copy_depths.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::raster)

// Copies rows of whole cache lines; their addresses are aligned to a cache line.
void copy_lines(const float* from, int width, int height, float* to, std::size_t stride) {
    static_assert(kFloatsOfLine % kLanes == 0);
    for (int y = 0; y < height; ++y, from += kTileSize, to += stride)
        for (int x = 0; x < width; x += kLanes)
            stream(load<F32>(from + x), to + x);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(copy_lines);

void copy_depths(const VisibilityTile& tile, float* to, std::size_t stride) {
    constexpr std::size_t kFloats = kFloatsOfLine;
    const image::Rect& area = tile.area();
    const float* from = tile.depths(0).data();
    const auto address = reinterpret_cast<std::uintptr_t>(to);
    const bool lines = address % (kFloats * sizeof(float)) == 0 && stride % kFloats == 0 &&
                       area.width() % kFloatsOfLine == 0;
    if (lines) return SIMD_CALL(copy_lines, from, area.width(), area.height(), to, stride);
    for (int y = 0; y < area.height(); ++y, from += kTileSize, to += stride)
        std::copy_n(from, area.width(), to);
}

} // namespace scanout::raster
#endif
