#include "raster/coverage.h"

#include "raster/block_walk.h"

#include <algorithm>
#include <cmath>

#define SIMD_FILE "raster/coverage.cpp"
#include "simd/for_each_target.h"

#include "raster/show-inl.h"

SIMD_BEGIN(scanout::raster)

struct Block {
    std::int32_t first[3];           // floor((E + bias) / 256) at the first pixel's sample
    std::int32_t per_x[3], per_y[3]; // 0 where the edge holds for the whole block
    float base, rest, per_pixel_x, per_pixel_y;   // flat depth
    double edge[3], edge_per_x[3], edge_per_y[3]; // E itself; the other path
    std::uint32_t id;
};

// A row of the block: y pixels down. sample_x, sample_y: in pixels, from a pixel's corner.
template <bool kFlat, bool kUsual>
HWY_INLINE void draw_row(const VisibleRule& rule, const BlockWalk& walk, const Block& b, int y,
                         float sample_x, float sample_y, float* depth, std::uint32_t* id,
                         I32x8& drawn) {
    for (int x = 0; x < BlockWalk::kSide; x += kLanesX8) {
        const I32x8 column = iota<I32x8>(x);
        const auto edge = [&](int k) {
            return I32x8(b.first[k] + b.per_y[k] * y) + I32x8(b.per_x[k]) * column;
        };
        const MaskX8 inside = (edge(0) | edge(1) | edge(2)) >= I32x8(0);
        F32x8 z;
        if constexpr (kFlat) {
            const F32x8 across = (to_f32(column) + F32x8(sample_x)) * F32x8(b.per_pixel_x);
            const float down = (static_cast<float>(y) + sample_y) * b.per_pixel_y;
            z = F32x8(b.base) + (F32x8(b.rest) + (across + F32x8(down)));
        } else {
            const F64x8 at = to_f64(column);
            const auto term = [&](int k) {
                const double start = b.edge[k] + b.edge_per_y[k] * y;
                return (F64x8(start) + at * F64x8(b.edge_per_x[k])) * F64x8(walk.depth.share[k]);
            };
            z = to_f32((term(0) + term(1)) + term(2));
        }
        if constexpr (kUsual)
            show(inside, z, b.id, depth + x, id + x, drawn);
        else
            show_by(rule, inside, z, b.id, depth + x, id + x, drawn);
    }
}

template <bool kFlat, bool kUsual>
HWY_INLINE void draw_block(const TilePlanes& tile, const BlockWalk& walk, int bx, int by,
                           I32x8& drawn) {
    constexpr int kSide = BlockWalk::kSide;
    const std::int64_t x = std::int64_t{tile.area.x0 + bx * kSide} * kSubpixel;
    const std::int64_t y = std::int64_t{tile.area.y0 + by * kSide} * kSubpixel;
    std::int64_t corner[3];
    bool whole[3];
    for (int k = 0; k < 3; ++k) {
        corner[k] = walk.edges.a[k] * x + walk.edges.b[k] * y + walk.edges.c[k];
        if (corner[k] + walk.highest[k] < 0) return;
        whole[k] = corner[k] + walk.lowest[k] >= 0;
    }
    Block b;
    b.id = walk.id;
    if constexpr (kFlat) {
        const double z = (static_cast<double>(corner[0]) * walk.depth.share[0] +
                          static_cast<double>(corner[1]) * walk.depth.share[1]) +
                         static_cast<double>(corner[2]) * walk.depth.share[2];
        b.base = static_cast<float>(z);
        b.rest = static_cast<float>(z - static_cast<double>(b.base));
        b.per_pixel_x = static_cast<float>(walk.depth.per_x);
        b.per_pixel_y = static_cast<float>(walk.depth.per_y);
    }
    const std::size_t plane = std::size_t{kTileSize} * kTileSize;
    const std::size_t first =
        static_cast<std::size_t>(by) * kSide * kTileSize + static_cast<std::size_t>(bx) * kSide;
    for (std::size_t s = 0; s < tile.pattern.size(); ++s) {
        const SampleOffset at = tile.pattern.data()[s];
        for (int k = 0; k < 3; ++k) {
            const std::int64_t a = walk.edges.a[k], e_b = walk.edges.b[k];
            const std::int64_t e = corner[k] + a * at.x + e_b * at.y;
            constexpr std::int64_t kMost = std::int64_t{1} << 29;
            const std::int64_t floor = (e + walk.edges.bias[k]) >> kSubpixelBits;
            const std::int64_t capped = floor < -kMost ? -kMost : (floor > kMost ? kMost : floor);
            b.first[k] = whole[k] ? 0 : static_cast<std::int32_t>(capped);
            b.per_x[k] = whole[k] ? 0 : static_cast<std::int32_t>(a);
            b.per_y[k] = whole[k] ? 0 : static_cast<std::int32_t>(e_b);
            if constexpr (!kFlat) {
                b.edge[k] = static_cast<double>(e);
                b.edge_per_x[k] = static_cast<double>(a * kSubpixel);
                b.edge_per_y[k] = static_cast<double>(e_b * kSubpixel);
            }
        }
        const float sample_x = static_cast<float>(at.x) / kSubpixel;
        const float sample_y = static_cast<float>(at.y) / kSubpixel;
        const int row0 = walk.row0 - by * kSide, row1 = walk.row1 - by * kSide;
        for (int row = row0 > 0 ? row0 : 0; row < (row1 < kSide ? row1 : kSide); ++row) {
            const std::size_t pixel = s * plane + first + static_cast<std::size_t>(row * kTileSize);
            draw_row<kFlat, kUsual>(tile.rule, walk, b, row, sample_x, sample_y, tile.depth + pixel,
                                    tile.id + pixel, drawn);
        }
    }
}

template <bool kUsual>
HWY_INLINE bool draw_blocks(const TilePlanes& tile, const BlockWalk& walk) {
    I32x8 drawn = 0;
    for (int by = walk.y0; by < walk.y1; ++by) {
        for (int bx = walk.x0; bx < walk.x1; ++bx) {
            if (walk.depth.flat)
                draw_block<true, kUsual>(tile, walk, bx, by, drawn);
            else
                draw_block<false, kUsual>(tile, walk, bx, by, drawn);
        }
    }
    return any(!(drawn == I32x8(0)));
}

bool draw_walk(const TilePlanes& tile, const BlockWalk& walk) {
    return draw_blocks<true>(tile, walk);
}
bool draw_walk_by_rule(const TilePlanes& tile, const BlockWalk& walk) {
    return draw_blocks<false>(tile, walk);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(draw_walk);
SIMD_REGISTER(draw_walk_by_rule);

DepthPlane depth_plane(const Triangle& t, const Edges& e) {
    DepthPlane plane{};
    const auto area = static_cast<double>(e.area);
    double terms = 0; // what may cancel in the sums below, across a block
    for (std::size_t i = 0; i < 3; ++i) {
        plane.share[i] = t.depth[i] / area;
        const auto a = static_cast<double>(e.a[i]), b = static_cast<double>(e.b[i]);
        terms += (std::abs(a) + std::abs(b)) * plane.share[i];
    }
    const auto gradient = [&](const std::array<std::int64_t, 3>& step) {
        return ((static_cast<double>(step[0]) * plane.share[0] +
                 static_cast<double>(step[1]) * plane.share[1]) +
                static_cast<double>(step[2]) * plane.share[2]) *
               kSubpixel;
    };
    plane.per_x = gradient(e.a);
    plane.per_y = gradient(e.b);
    const double least = std::min({t.depth[0], t.depth[1], t.depth[2]});
    constexpr double kBlock = BlockWalk::kSide;
    plane.flat = least >= 0x1p-100 &&
                 kBlock * (std::abs(plane.per_x) + std::abs(plane.per_y)) <= least / 32 &&
                 kBlock * kSubpixel * terms <= least * 0x1p20;
    return plane;
}

namespace {

// False when no block of the tile can hold a sample.
bool plan_walk(const TilePlanes& tile, const SampleExtent& extent, const Triangle& t,
               BlockWalk& walk) {
    const image::Rect box = pixel_bounds(t, tile.area.x1, tile.area.y1, extent);
    const int x0 = std::max(box.x0 - tile.area.x0, 0), y0 = std::max(box.y0 - tile.area.y0, 0);
    const int x1 = box.x1 - tile.area.x0, y1 = box.y1 - tile.area.y0;
    if (x0 >= x1 || y0 >= y1) return false;
    constexpr int kSide = BlockWalk::kSide;
    walk.x0 = x0 / kSide;
    walk.y0 = y0 / kSide;
    walk.x1 = (x1 + kSide - 1) / kSide;
    walk.y1 = (y1 + kSide - 1) / kSide;
    walk.row0 = y0;
    walk.row1 = y1;
    walk.id = t.id;
    walk.edges = edges_of(t);
    walk.depth = depth_plane(t, walk.edges);
    const std::int64_t across[2] = {extent.low.x, (kSide - 1) * kSubpixel + extent.high.x};
    const std::int64_t down[2] = {extent.low.y, (kSide - 1) * kSubpixel + extent.high.y};
    for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t a = walk.edges.a[k], b = walk.edges.b[k], bias = walk.edges.bias[k];
        walk.lowest[k] = bias + a * across[a < 0] + b * down[b < 0];
        walk.highest[k] = bias + a * across[a > 0] + b * down[b > 0];
    }
    return true;
}

} // namespace

bool draw_triangles(const TilePlanes& tile, std::span<const Triangle> triangles) {
    const SampleExtent extent = extent_of(tile.pattern);
    bool drawn = false;
    BlockWalk walk;
    const bool usual = tile.rule.usual();
    for (const Triangle& t : triangles)
        if (plan_walk(tile, extent, t, walk))
            drawn |=
                usual ? SIMD_CALL(draw_walk)(tile, walk) : SIMD_CALL(draw_walk_by_rule)(tile, walk);
    return drawn;
}

} // namespace scanout::raster
#endif
