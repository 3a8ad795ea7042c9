// Block rejection: which blocks of a tile a large triangle may be visible in, by its edges and by
// the hierarchical Z. Included once for every SIMD target.
#if defined(SCANOUT_RASTER_COVERAGE_REJECT_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_COVERAGE_REJECT_BLOCKS_INL_H
#undef SCANOUT_RASTER_COVERAGE_REJECT_BLOCKS_INL_H
#else
#define SCANOUT_RASTER_COVERAGE_REJECT_BLOCKS_INL_H
#endif

#include "raster/coverage/block_traversal.h"

#include "raster/coverage/depth_write-inl.h"

SIMD_BEGIN(scanout::raster)

// The farthest depth in a block; pixel_offset: of its first pixel.
SIMD_INLINE float far_depth_in(const TilePlanes& tile, std::ptrdiff_t pixel_offset) {
    const float* depth = tile.depth + pixel_offset;
    F32x8 nearest_lane = load<F32x8>(depth);
    for (std::size_t s = 0; s < tile.pattern.size(); ++s, depth += kTileSize * kTileSize)
        SIMD_FOR (int y = 0; y < PixelBlock::kSide; ++y)
            for (int x = 0; x < PixelBlock::kSide; x += kLanesX8)
                nearest_lane = minimum(nearest_lane, load<F32x8>(depth + y * kTileSize + x));
    return least(nearest_lane);
}

// Does a block occlude everything at depth `nearest` or behind, by its present depths? For clipped
// triangles and clusters that tile.hi_z does not reject, since small and clipped triangles do not
// update hi_z. Reads the block again only if its middle pixel occludes: else the block cannot.
SIMD_INLINE bool occludes_after_refresh(const TilePlanes& tile, int x, int y, float nearest) {
    constexpr int kSide = PixelBlock::kSide, kMiddle = kSide / 2 * (kTileSize + 1);
    const int pixel_offset = (y * kTileSize + x) * kSide;
    if (!(nearest < tile.depth[pixel_offset + kMiddle])) return false;
    float& farthest = tile.hi_z[y * (kTileSize / kSide) + x];
    farthest = far_depth_in(tile, pixel_offset);
    return nearest < farthest;
}
// The farthest depth in the tile.
SIMD_INLINE float far_depth_of_tile(const TilePlanes& tile) {
    F32 all = load<F32>(tile.hi_z);
    SIMD_FOR (int i = 0; i < BlockList::kBlocks; i += kLanes)
        all = minimum(all, load<F32>(tile.hi_z + i));
    return least(all);
}

// Computes bounds of the edges and the depth of each block in float; lanes are the blocks of the
// tile. Returns bit 8 y + x for each block in which the triangle may be visible, by the
// hierarchical Z so far. nearest: an upper bound of the depth in each block.
template <bool kDefault>
SIMD_INLINE std::uint64_t reject_blocks(const TilePlanes& tile, const BlockBounds& b,
                                        float* nearest) {
    constexpr int kRow = BlockList::kRow;
    static_assert(kRow == PixelBlock::kSide);
    const bool use_hi_z = kDefault && tile.hi_z != nullptr;
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
            auto visible = (edge[0][r] >= zero) & (edge[1][r] >= zero) & (edge[2][r] >= zero);
            const F32 here = minimum(depth[r], most);
            if (use_hi_z) visible = visible & !(here < load<F32>(tile.hi_z + first));
            if (nearest != nullptr) store(here, nearest + first);
            live |= std::uint64_t{bits(visible)} << first;
            depth[r] = depth[r] + farther;
            SIMD_FOR (int k = 0; k < 3; ++k)
                edge[k][r] = edge[k][r] + down[k];
        }
    }
    // The bits of all rows above y.
    const auto above = [](int y) SIMD_LAMBDA {
        return y < kRow ? (std::uint64_t{1} << y * kRow) - 1 : ~std::uint64_t{0};
    };
    const std::uint64_t columns = (1U << b.x1) - (1U << b.x0);
    return live & columns * 0x0101010101010101 & (above(b.y1) & ~above(b.y0));
}

SIMD_END

#endif
