#include "shade/place_lanes.h"

#include "raster/coverage/coverage.h"
#include "raster/screen/sample_pattern.h"

#define SIMD_FILE "shade/place_lanes.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::shade)

constexpr int kRowBits = 6;
static_assert(raster::kTileSize == 1 << kRowBits);

void place(Block& b, const std::int32_t* pixel, int first, int count, int x0, int y0) {
    const I32 left = x0, top = y0, end = first + count;
    for (int i = first; i < first + count; i += kLanes) {
        const I32 at = load<I32>(pixel + i);
        const I32 row = shift_right<kRowBits>(at);
        const I32 column = at - shift_left<kRowBits>(row);
        const I32 x = shift_left<raster::kSubpixelBits>(left + column) + raster::kPixelCentre.x;
        const I32 y = shift_left<raster::kSubpixelBits>(top + row) + raster::kPixelCentre.y;
        const auto live = iota<I32>(i) < end; // those behind have their places
        store(select(live, x, load<I32>(b.x + i)), b.x + i);
        store(select(live, y, load<I32>(b.y + i)), b.y + i);
    }
}

void cast(Block& b, const Rays& rays) {
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 x = to_f32(load<I32>(b.x + i)) * F32(1.0F / 256);
        const F32 y = to_f32(load<I32>(b.y + i)) * F32(1.0F / 256);
        store(x * F32(rays.scale_x) + F32(rays.offset_x), b.ray_x + i);
        store(y * F32(rays.scale_y) + F32(rays.offset_y), b.ray_y + i);
    }
}

void put(const std::uint32_t* code, const std::int32_t* pixel, int count, image::Rgba8* corner,
         int width) {
    alignas(64) std::uint32_t place[kPaddedBlock];
    const I32 down = width - raster::kTileSize; // besides a row of the tile
    for (int i = 0; i < count; i += kLanes) {
        const I32 at = load<I32>(pixel + i);
        store(at + shift_right<kRowBits>(at) * down, place + i);
    }
    const auto lanes = static_cast<std::size_t>(count);
#pragma GCC unroll 4
    for (std::size_t lane = 0; lane < lanes; ++lane)
        __builtin_memcpy(static_cast<void*>(corner + place[lane]), code + lane, sizeof *code);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade {

SIMD_REGISTER(place);
SIMD_REGISTER(cast);
SIMD_REGISTER(put);

void place_at_centres(Block& block, const std::int32_t* pixel, int first, int count, int x0,
                      int y0) {
    SIMD_CALL(place, block, pixel, first, count, x0, y0);
}

void set_rays(Block& block, const Rays& rays) {
    SIMD_CALL(cast, block, rays);
}

void put_codes(const std::uint32_t* code, const std::int32_t* pixel, int count,
               image::Rgba8* corner, int width) {
    SIMD_CALL(put, code, pixel, count, corner, width);
}

} // namespace scanout::shade
#endif
