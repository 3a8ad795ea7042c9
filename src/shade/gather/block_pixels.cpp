#include "shade/gather/block_pixels.h"

#include "raster/coverage/coverage.h"
#include "raster/screen/sample_pattern.h"

#define SIMD_FILE "shade/gather/block_pixels.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::shade)

constexpr int kRowBits = 6;
static_assert(raster::kTileSize == 1 << kRowBits);

void centre(ShadingBlock& b, const std::int32_t* pixel, int first, int count, int x0, int y0) {
    const I32 left = x0, top = y0, end = first + count;
    for (int i = first; i < first + count; i += kLanes) {
        const I32 at = load<I32>(pixel + i);
        const I32 row = shift_right<kRowBits>(at);
        const I32 column = at - shift_left<kRowBits>(row);
        const I32 x = shift_left<raster::kSubpixelBits>(left + column) + raster::kPixelCentre.x;
        const I32 y = shift_left<raster::kSubpixelBits>(top + row) + raster::kPixelCentre.y;
        const auto live = iota<I32>(i) < end; // later items have their pixels already
        store(select(live, x, load<I32>(b.x + i)), b.x + i);
        store(select(live, y, load<I32>(b.y + i)), b.y + i);
    }
}

void cast(ShadingBlock& b, const Rays& rays) {
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 x = to_f32(load<I32>(b.x + i)) * F32(1.0F / 256);
        const F32 y = to_f32(load<I32>(b.y + i)) * F32(1.0F / 256);
        store(x * F32(rays.scale_x) + F32(rays.offset_x), b.ray_x + i);
        store(y * F32(rays.scale_y) + F32(rays.offset_y), b.ray_y + i);
    }
}

void scatter(const std::uint32_t* code, const std::int32_t* pixel, int count, image::Rgba8* corner,
             int width) {
    alignas(64) std::uint32_t offset[kPaddedBlock];
    const I32 down = width - raster::kTileSize; // besides a row of the tile
    for (int i = 0; i < count; i += kLanes) {
        const I32 at = load<I32>(pixel + i);
        store(at + shift_right<kRowBits>(at) * down, offset + i);
    }
    const auto items = static_cast<std::size_t>(count);
#pragma GCC unroll 4
    for (std::size_t item = 0; item < items; ++item)
        __builtin_memcpy(static_cast<void*>(corner + offset[item]), code + item, sizeof *code);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade {

SIMD_REGISTER(centre);
SIMD_REGISTER(cast);
SIMD_REGISTER(scatter);

void place_at_centres(ShadingBlock& block, const std::int32_t* pixel, int first, int count, int x0,
                      int y0) {
    SIMD_CALL(centre, block, pixel, first, count, x0, y0);
}

void set_rays(ShadingBlock& block, const Rays& rays) {
    SIMD_CALL(cast, block, rays);
}

void store_codes(const std::uint32_t* code, const std::int32_t* pixel, int count,
                 image::Rgba8* corner, int width) {
    SIMD_CALL(scatter, code, pixel, count, corner, width);
}

} // namespace scanout::shade
#endif
