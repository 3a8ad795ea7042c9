// Which blocks of a tile a large triangle may show in. Included once for every SIMD target.
#if defined(SCANOUT_RASTER_FIND_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_FIND_BLOCKS_INL_H
#undef SCANOUT_RASTER_FIND_BLOCKS_INL_H
#else
#define SCANOUT_RASTER_FIND_BLOCKS_INL_H
#endif

#include "raster/block_walk.h"

#include "raster/show-inl.h"

SIMD_BEGIN(scanout::raster)

// The farthest depth in a block; place: of its first pixel.
HWY_INLINE float farthest_in(const TilePlanes& tile, std::ptrdiff_t place) {
    const float* depth = tile.depth + place;
    F32x8 least = load<F32x8>(depth);
    for (std::size_t s = 0; s < tile.pattern.size(); ++s, depth += kTileSize * kTileSize)
        SIMD_UNROLL
    for (int y = 0; y < BlockWalk::kSide; ++y)
        for (int x = 0; x < BlockWalk::kSide; x += kLanesX8)
            least = minimum(least, load<F32x8>(depth + y * kTileSize + x));
    float lane[kLanesX8], farthest;
    store(least, lane);
    farthest = lane[0];
    for (int i = 1; i < kLanesX8; ++i)
        farthest = lane[i] < farthest ? lane[i] : farthest;
    return farthest;
}

// Is a block all behind what is there by now? Asked where tile.farthest, which is of when it was
// last looked through, does not hide it. nearest: no depth in it is nearer. It is looked through
// anew only where its middle pixel hides the triangle: else the block cannot.
HWY_INLINE bool hides_by_now(const TilePlanes& tile, int x, int y, float nearest) {
    constexpr int kSide = BlockWalk::kSide, kMiddle = kSide / 2 * (kTileSize + 1);
    const int place = (y * kTileSize + x) * kSide;
    if (!(nearest < tile.depth[place + kMiddle])) return false;
    float& farthest = tile.farthest[y * (kTileSize / kSide) + x];
    farthest = farthest_in(tile, place);
    return nearest < farthest;
}
// As was known or is by now.
HWY_INLINE bool hides(const TilePlanes& tile, int x, int y, float nearest) {
    return nearest < tile.farthest[y * (kTileSize / BlockWalk::kSide) + x] ||
           hides_by_now(tile, x, y, nearest);
}

// Bounds of the edges and the depth of each block in float, a row of blocks side by side.
template <bool kUsual>
HWY_INLINE void find_blocks(const TilePlanes& tile, const BlockBounds& b, BlockList& out) {
    constexpr int kRow = BlockList::kRow, kAcross = kRow / kLanesX8;
    const bool ask = kUsual && tile.farthest != nullptr;
    const auto lanes = [](double first, double per_block, int r) HWY_ATTR {
        return F32x8(static_cast<float>(first)) +
               to_f32(iota<I32x8>(r * kLanesX8)) * F32x8(static_cast<float>(per_block));
    };
    F32x8 edge[3][kAcross], down[3], nearest[kAcross];
    const F32x8 farther = static_cast<float>(b.depth_down), zero = 0.0F;
    SIMD_UNROLL
    for (int r = 0; r < kAcross; ++r) {
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            edge[k][r] = lanes(b.edge[k], b.across[k], r);
        nearest[r] = lanes(b.depth, b.depth_across, r);
    }
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        down[k] = static_cast<float>(b.down[k]);
    const std::uint32_t columns = (1U << b.x1) - (1U << b.x0);
    out.count = 0;
    for (int y = 0; y < b.y1; ++y) {
        std::uint32_t live = 0;
        float depth[kRow];
        SIMD_UNROLL
        for (int r = 0; r < kAcross; ++r) {
            auto seen = (edge[0][r] >= zero) & (edge[1][r] >= zero) & (edge[2][r] >= zero);
            if (ask) // of a whole row: what one block answers is hard to foretell
                seen = seen & !(nearest[r] < load<F32x8>(tile.farthest + y * kRow + r * kLanesX8));
            live |= bits(seen) << (r * kLanesX8);
            if (kUsual) store(nearest[r], depth + r * kLanesX8);
            nearest[r] = nearest[r] + farther;
            SIMD_UNROLL
            for (int k = 0; k < 3; ++k)
                edge[k][r] = edge[k][r] + down[k];
        }
        if (y < b.y0) continue;
        for (live &= columns; live != 0; live &= live - 1) {
            const int x = __builtin_ctz(live);
            if (ask && hides_by_now(tile, x, y, depth[x])) continue;
            out.x[out.count] = x;
            out.y[out.count++] = y;
        }
    }
    static_assert(kLanesX8 <= BlockWalk::kSide);
    for (int k = 0; k < BlockWalk::kSide; ++k) // what the last register reads beyond
        out.x[out.count + k] = out.y[out.count + k] = 0;
}

SIMD_END

#endif
