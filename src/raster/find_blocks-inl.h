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
SIMD_INLINE float farthest_in(const TilePlanes& tile, std::ptrdiff_t place) {
    const float* depth = tile.depth + place;
    F32x8 nearest_lane = load<F32x8>(depth);
    for (std::size_t s = 0; s < tile.pattern.size(); ++s, depth += kTileSize * kTileSize)
        SIMD_FOR (int y = 0; y < BlockWalk::kSide; ++y)
            for (int x = 0; x < BlockWalk::kSide; x += kLanesX8)
                nearest_lane = minimum(nearest_lane, load<F32x8>(depth + y * kTileSize + x));
    return least(nearest_lane);
}

// Is a block all behind what is there by now? Asked, of pieces and of clusters, where
// tile.farthest, which does not know of what small triangles and pieces have drawn since, does not
// hide it. nearest: no depth in it is
// nearer. It is looked through anew only where its middle pixel hides the triangle: else the block
// cannot.
SIMD_INLINE bool hides_by_now(const TilePlanes& tile, int x, int y, float nearest) {
    constexpr int kSide = BlockWalk::kSide, kMiddle = kSide / 2 * (kTileSize + 1);
    const int place = (y * kTileSize + x) * kSide;
    if (!(nearest < tile.depth[place + kMiddle])) return false;
    float& farthest = tile.farthest[y * (kTileSize / kSide) + x];
    farthest = farthest_in(tile, place);
    return nearest < farthest;
}
// Nothing seen anywhere in the tile is farther away.
SIMD_INLINE float farthest_of_all(const TilePlanes& tile) {
    F32 all = load<F32>(tile.farthest);
    SIMD_FOR (int i = 0; i < BlockList::kBlocks; i += kLanes)
        all = minimum(all, load<F32>(tile.farthest + i));
    return least(all);
}

// Bounds of the edges and the depth of each block in float, side by side, where lanes are blocks of
// the tile as they are pixels of a block elsewhere. Bit 8 y + x of what may be seen, by what is
// known of the blocks so far. nearest: no depth in a block is nearer.
template <bool kUsual>
SIMD_INLINE std::uint64_t find_blocks(const TilePlanes& tile, const BlockBounds& b,
                                      float* nearest) {
    constexpr int kRow = BlockList::kRow;
    static_assert(kRow == BlockWalk::kSide);
    const bool ask = kUsual && tile.farthest != nullptr;
    const auto lanes = [](float first, float across, float down, int r) SIMD_LAMBDA {
        return F32(first) + (to_f32(columns(r)) * F32(across) + to_f32(rows()) * F32(down));
    };
    F32 edge[3][kRegisters], down[3], depth[kRegisters];
    const F32 farther = b.depth_down * kRows, most = b.most, zero = 0.0F;
    SIMD_FOR (int r = 0; r < kRegisters; ++r) {
        SIMD_FOR (int k = 0; k < 3; ++k)
            edge[k][r] = lanes(b.edge[k], b.across[k], b.down[k], r);
        depth[r] = lanes(b.depth, b.depth_across, b.depth_down, r);
    }
    SIMD_FOR (int k = 0; k < 3; ++k)
        down[k] = b.down[k] * kRows;
    std::uint64_t live = 0;
    SIMD_FOR (int y = 0; y < kRow; y += kRows) {
        SIMD_FOR (int r = 0; r < kRegisters; ++r) {
            const int first = y * kRow + r * kLanes;
            auto seen = (edge[0][r] >= zero) & (edge[1][r] >= zero) & (edge[2][r] >= zero);
            const F32 here = minimum(depth[r], most);
            if (ask) seen = seen & !(here < load<F32>(tile.farthest + first));
            if (nearest != nullptr) store(here, nearest + first);
            live |= std::uint64_t{bits(seen)} << first;
            depth[r] = depth[r] + farther;
            SIMD_FOR (int k = 0; k < 3; ++k)
                edge[k][r] = edge[k][r] + down[k];
        }
    }
    // All rows above y.
    const auto above = [](int y) SIMD_LAMBDA {
        return y < kRow ? (std::uint64_t{1} << y * kRow) - 1 : ~std::uint64_t{0};
    };
    const std::uint64_t columns = (1U << b.x1) - (1U << b.x0);
    return live & columns * 0x0101010101010101 & (above(b.y1) & ~above(b.y0));
}

SIMD_END

#endif
