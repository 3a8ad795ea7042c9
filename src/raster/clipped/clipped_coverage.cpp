// Coverage and depth of clipped triangles. Block traversal as in raster/coverage/coverage.cpp, but
// edge functions have up to 126 bits: a block that no edge crosses takes three of them, and lanes
// do the rest; in one that an edge crosses lanes find the sign in double wherever rounding cannot
// change it, and integers where it can.
#include "base/check.h"
#include "raster/clipped/clipped_setup.h"
#include "raster/coverage/block_traversal.h"
#include "raster/coverage/coverage.h"

#include <algorithm>
#include <bit>
#include <cmath>

#define SIMD_FILE "raster/clipped/clipped_coverage.cpp"
#include "simd/for_each_target.h"

#include "raster/coverage/reject_blocks-inl.h"

SIMD_BEGIN(scanout::raster)

template <DepthWrite kWrite>
SIMD_INLINE bool draw(const DepthRule& rule, const ClippedBlock& b, float* depth,
                      std::uint32_t* id) {
    constexpr int kSide = PixelBlock::kSide;
    alignas(32) constexpr std::int32_t kBit[kSide] = {1, 2, 4, 8, 16, 32, 64, 128};
    I32x8 drawn = 0;
    for (int y = 0; y < kSide; ++y) {
        const I32x8 row = static_cast<std::int32_t>(b.inside >> (y * kSide) & 0xff);
        for (int x = 0; x < kSide; x += kLanesX8) {
            const MaskX8 inside = !((row & load<I32x8>(kBit + x)) == I32x8(0));
            if (!any(inside)) continue;
            F32x8 z;
            if (b.depths != nullptr) {
                z = load<F32x8>(b.depths + std::ptrdiff_t{y} * kSide + x);
            } else {
                const F64x8 across = to_f64(iota<I32x8>(x)) * F64x8(b.per_x);
                const F64x8 at = F64x8(b.corner) + (across + F64x8(y * b.per_y));
                z = to_f32(minimum(maximum(at, F64x8(b.least)), F64x8(b.most)));
            }
            const std::ptrdiff_t pixel = std::ptrdiff_t{y} * kTileSize + x;
            write_samples<kWrite>(rule, inside, z, b.id, depth + pixel, id_after<kWrite>(id, pixel),
                                  drawn);
        }
    }
    return any(!(drawn == I32x8(0)));
}

bool draw_block(const ClippedBlock& b, float* depth, std::uint32_t* id) {
    return draw<DepthWrite::nearest>({}, b, depth, id);
}
bool draw_block_depth(const ClippedBlock& b, float* depth) {
    return draw<DepthWrite::depth_only>({}, b, depth, nullptr);
}
bool draw_block_by_rule(const DepthRule& rule, const ClippedBlock& b, float* depth,
                        std::uint32_t* id) {
    return draw<DepthWrite::by_rule>(rule, b, depth, id);
}

ClippedBlockSigns block_signs(const ClippedBlockEdges& e) {
    constexpr int kSide = PixelBlock::kSide;
    std::uint64_t outside = 0, unsure = 0;
    for (int k = 0; k < 3; ++k) {
        const F64x8 error = e.error[k];
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; x += kLanesX8) {
                const F64x8 at =
                    F64x8(e.first[k] + y * e.per_y[k]) + to_f64(iota<I32x8>(x)) * F64x8(e.per_x[k]);
                const int bit = y * kSide + x;
                const std::uint32_t close = bits(abs(at) < error);
                outside |= std::uint64_t{bits(at < F64x8(0.0)) & ~close} << bit;
                unsure |= std::uint64_t{close} << bit;
            }
    }
    return {~outside & ~unsure, unsure & ~outside};
}

void blocks_of_clipped(const TilePlanes& tile, const BlockBounds& bounds, BlockList& out) {
    float nearest[BlockList::kBlocks];
    const bool use_hi_z = tile.rule.is_default() && tile.hi_z != nullptr;
    std::uint64_t live = use_hi_z ? reject_blocks<true>(tile, bounds, nearest)
                                  : reject_blocks<false>(tile, bounds, nearest);
    out.count = 0;
    for (; live != 0; live &= live - 1) {
        const int block = __builtin_ctzll(live);
        const int x = block % BlockList::kRow, y = block / BlockList::kRow;
        if (use_hi_z && occludes_after_refresh(tile, x, y, nearest[block])) continue;
        out.x[out.count] = x;
        out.y[out.count++] = y;
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(draw_block);
SIMD_REGISTER(draw_block_depth);
SIMD_REGISTER(block_signs);
SIMD_REGISTER(blocks_of_clipped);
SIMD_REGISTER(draw_block_by_rule);

namespace {

constexpr int kSide = PixelBlock::kSide;
constexpr std::int64_t kBlock = std::int64_t{kSide} * kSubpixel;

class ClippedRasteriser {
public:
    ClippedRasteriser(const TilePlanes& tile, const ClippedSetup& clipped)
        : tile_(tile), clipped_(clipped), edges_(clipped.edges) {}

    bool draw() {
        const image::Rect& box = clipped_.box;
        const image::Rect here = {std::max(box.x0, tile_.area.x0), std::max(box.y0, tile_.area.y0),
                                  std::min(box.x1, tile_.area.x1), std::min(box.y1, tile_.area.y1)};
        if (here.empty() || !reaches_tile()) return false; // most tiles that its box touches
        BlockList blocks;
        SIMD_CALL(blocks_of_clipped, tile_, bounds_of(here), blocks);
        bool drawn = false;
        for (int i = 0; i < blocks.count; ++i)
            drawn |= draw_block_at(blocks.x[i], blocks.y[i]);
        return drawn;
    }

private:
    // Can the tile hold a covered sample? Notes which edges hold for all of it.
    bool reaches_tile() {
        const EdgeExtent& tile = clipped_.of_tile;
        for (std::size_t k = 0; k < 3; ++k) {
            const Int128 corner = at(k, tile_.area.x0, tile_.area.y0);
            if (corner + tile.highest[k] < 0) return false;
            whole_tile_[k] = corner + tile.lowest[k] >= 0;
        }
        return true;
    }
    // Of each edge in units of its terms, so that float holds them.
    BlockBounds bounds_of(const image::Rect& box) const {
        BlockBounds b{};
        double nearest = 0, per_across = 0, per_down = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto corner = static_cast<double>(at(k, tile_.area.x0, tile_.area.y0)),
                       highest = static_cast<double>(clipped_.of_block.highest[k]),
                       across = clipped_.a[k] * static_cast<double>(kBlock),
                       down = clipped_.b[k] * static_cast<double>(kBlock);
            const double terms = std::abs(corner) + std::abs(highest) +
                                 BlockList::kRow * (std::abs(across) + std::abs(down));
            b.edge[k] = static_cast<float>((corner + highest) / terms + BlockBounds::kMargin);
            b.across[k] = static_cast<float>(across / terms);
            b.down[k] = static_cast<float>(down / terms);
            nearest += corner * clipped_.depth_factor[k] +
                       BlockBounds::kMargin * terms * std::abs(clipped_.depth_factor[k]);
            per_across += across * clipped_.depth_factor[k];
            per_down += down * clipped_.depth_factor[k];
        }
        nearest += std::max(per_across, 0.0) + std::max(per_down, 0.0);
        b.most = static_cast<float>(clipped_.most * (1 + BlockBounds::kMargin));
        b.depth = b.most; // where float may not hold the others
        if (std::abs(nearest) + std::abs(per_across) + std::abs(per_down) < 0x1p120) {
            b.depth = static_cast<float>(nearest);
            b.depth_across = static_cast<float>(per_across);
            b.depth_down = static_cast<float>(per_down);
        }
        b.x0 = (box.x0 - tile_.area.x0) / kSide;
        b.y0 = (box.y0 - tile_.area.y0) / kSide;
        b.x1 = (box.x1 - tile_.area.x0 + kSide - 1) / kSide;
        b.y1 = (box.y1 - tile_.area.y0 + kSide - 1) / kSide;
        return b;
    }
    Int128 at(std::size_t k, int x, int y) const { // pixels
        return edges_.at(k, std::int64_t{x} * kSubpixel, std::int64_t{y} * kSubpixel);
    }

    bool draw_block_at(int bx, int by) {
        Int128 corner[3];
        bool whole[3];
        for (std::size_t k = 0; k < 3; ++k) {
            corner[k] = at(k, tile_.area.x0 + bx * kSide, tile_.area.y0 + by * kSide);
            whole[k] = whole_tile_[k] || corner[k] + clipped_.of_block.lowest[k] >= 0;
        }
        ClippedBlock b{};
        b.id = clipped_.triangle.id;
        b.least = clipped_.least;
        b.most = clipped_.most;
        double depth = 0;
        const bool plane = is_plane(corner, depth);
        b.per_x = clipped_.per_x * kSubpixel;
        b.per_y = clipped_.per_y * kSubpixel;
        float depths[kSide * kSide];
        bool drawn = false;
        for (std::size_t s = 0; s < tile_.pattern.size(); ++s) {
            const SampleOffset offset = tile_.pattern[s];
            Int128 e[3];
            for (std::size_t k = 0; k < 3; ++k)
                e[k] = corner[k] + edges_.a[k] * offset.x + edges_.b[k] * offset.y;
            b.inside = inside(e, whole);
            if (b.inside == 0) continue;
            b.corner = depth + (offset.x * clipped_.per_x + offset.y * clipped_.per_y);
            b.depths = plane ? nullptr : depths;
            if (!plane) find_depths(e, b.inside, depths);
            const std::size_t first = s * std::size_t{kTileSize} * kTileSize +
                                      static_cast<std::size_t>(by * kSide * kTileSize + bx * kSide);
            drawn |= write(b, first);
        }
        return drawn;
    }
    // first: of the block's pixels, in the planes.
    bool write(const ClippedBlock& b, std::size_t first) const {
        float* const depth = tile_.depth + first;
        if (tile_.id == nullptr) return SIMD_CALL(draw_block_depth, b, depth);
        std::uint32_t* const id = tile_.id + first;
        return tile_.rule.is_default() ? SIMD_CALL(draw_block, b, depth, id)
                                       : SIMD_CALL(draw_block_by_rule, tile_.rule, b, depth, id);
    }

    // e: at the first pixel's sample. Bit 8 y + x.
    std::uint64_t inside(const Int128 (&e)[3], const bool (&whole)[3]) const {
        if (whole[0] && whole[1] && whole[2]) return ~std::uint64_t{0};
        ClippedBlockEdges edges{};
        for (std::size_t k = 0; k < 3; ++k) {
            if (whole[k]) continue;
            edges.first[k] = static_cast<double>(e[k]);
            edges.per_x[k] = clipped_.a[k] * kSubpixel;
            edges.per_y[k] = clipped_.b[k] * kSubpixel;
            // Eight roundings of 2^-53 of the terms, and more.
            edges.error[k] = (std::abs(edges.first[k]) +
                              kSide * (std::abs(edges.per_x[k]) + std::abs(edges.per_y[k]))) *
                             0x1p-48;
        }
        auto [inside, unsure] = SIMD_CALL(block_signs, edges);
        for (; unsure != 0; unsure &= unsure - 1) {
            const int pixel = std::countr_zero(unsure);
            const int x = pixel % kSide * kSubpixel, y = pixel / kSide * kSubpixel;
            bool in = true;
            for (std::size_t k = 0; k < 3; ++k)
                in = in && (whole[k] || e[k] + edges_.a[k] * x + edges_.b[k] * y >= 0);
            inside |= (in ? std::uint64_t{1} : 0) << pixel;
        }
        return inside;
    }

    // Is depth, from a plane in double about the block's corner, within 2^-28 of itself at every
    // covered sample? It errs by less than 8 units of 2^-53 of the terms that may cancel in the
    // sum; and it is nowhere less than at the lowest vertex, nor than where the plane is lowest in
    // the block.
    bool is_plane(const Int128 (&corner)[3], double& depth) const {
        const double e[3] = {static_cast<double>(corner[0]), static_cast<double>(corner[1]),
                             static_cast<double>(corner[2])};
        depth = clipped_.depth_of(e);
        double cancels = static_cast<double>(kBlock) * clipped_.terms;
        for (std::size_t k = 0; k < 3; ++k)
            cancels += std::abs(e[k] * clipped_.depth_factor[k]);
        const double down = std::min(clipped_.per_x, 0.0) + std::min(clipped_.per_y, 0.0);
        const double least = std::max(clipped_.least, depth + static_cast<double>(kBlock) * down);
        return cancels <= least * 0x1p22;
    }
    // Elsewhere: from the edge functions at the sample itself. No term is negative.
    void find_depths(const Int128 (&first)[3], std::uint64_t inside, float* out) const {
        for (int pixel = 0; pixel < kSide * kSide; ++pixel) {
            out[pixel] = 0;
            if ((inside >> pixel & 1) == 0) continue;
            const int x = pixel % kSide * kSubpixel, y = pixel / kSide * kSubpixel;
            double e[3];
            for (std::size_t k = 0; k < 3; ++k)
                e[k] = static_cast<double>(first[k] + edges_.a[k] * x + edges_.b[k] * y);
            out[pixel] =
                static_cast<float>(std::clamp(clipped_.depth_of(e), clipped_.least, clipped_.most));
        }
    }

    const TilePlanes& tile_;
    const ClippedSetup& clipped_;
    const ExactEdges& edges_;
    bool whole_tile_[3] = {};
};

// Does the first hold all of the second?
bool contains(const SampleExtent& outer, const SampleExtent& inner) {
    return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y &&
           outer.high.x >= inner.high.x && outer.high.y >= inner.high.y;
}

} // namespace

bool draw_clipped(const TilePlanes& tile, const ClippedSetup& clipped) {
    CHECK(contains(clipped.extent, extent_of(tile.pattern))); // else it would reach too few tiles
    return ClippedRasteriser(tile, clipped).draw();
}

} // namespace scanout::raster
#endif
