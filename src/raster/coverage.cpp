#include "raster/coverage.h"

#define SIMD_FILE "raster/coverage.cpp"
#include "simd/for_each_target.h"

#include "raster/blocks-inl.h"

SIMD_BEGIN(scanout::raster)

// Blocks are few: those of all triangles side by side, one after the other.
template <Shows kShows>
HWY_INLINE void draw_small(const TilePlanes& tile, const Walks& w, int i, std::uint32_t live,
                           I32& drawn) {
    WalkLanes lanes =
        walk_lanes(w, [&](const double* from) HWY_ATTR { return load<F64x8>(from + i); });
    lanes.x0 = load<I32x8>(w.x0 + i);
    lanes.y0 = load<I32x8>(w.y0 + i);
    lanes.x1 = load<I32x8>(w.x1 + i);
    lanes.y1 = load<I32x8>(w.y1 + i);
    const I32x8 x0 = shift_right<3>(lanes.x0), x1 = shift_right<3>(lanes.x1 + 7);
    const I32x8 y1 = shift_right<3>(lanes.y1 + 7);
    I32x8 x = x0, y = shift_right<3>(lanes.y0);
    while (live != 0) {
        const AtBlocks blocks = at_blocks(tile, lanes, x, y);
        const std::uint32_t show = seen<is_usual(kShows)>(tile, lanes, blocks, live);
        if (show != 0) draw_flat<kShows, false>(tile, lanes, blocks, show, w.id + i, drawn);
        x = x + 1;
        const MaskX8 next = x >= x1;
        x = select(next, x0, x);
        y = select(next, y + 1, y);
        live &= bits(y < y1);
    }
}

HWY_INLINE BlockBounds bounds_of(const TilePlanes& tile, const Walks& w, int i) {
    constexpr int kSide = BlockWalk::kSide;
    constexpr double kBlock = kSide * kSubpixel;
    BlockBounds b;
    b.depth = 0;
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        const double corner =
            (w.a[k][i] * (tile.area.x0 * kSubpixel) + w.b[k][i] * (tile.area.y0 * kSubpixel)) +
            w.c[k][i];
        b.across[k] = w.a[k][i] * kBlock;
        b.down[k] = w.b[k][i] * kBlock;
        const double terms = (std::abs(corner) + std::abs(w.highest[k][i])) +
                             BlockList::kRow * (std::abs(b.across[k]) + std::abs(b.down[k]));
        b.edge[k] = (corner + w.highest[k][i]) + terms * BlockBounds::kMargin;
        b.depth += (corner + terms * BlockBounds::kMargin) * w.share[k][i];
    }
    b.depth_across = w.per_x[i] * kSide;
    b.depth_down = w.per_y[i] * kSide;
    b.depth += (b.depth_across > 0 ? b.depth_across : 0) + (b.depth_down > 0 ? b.depth_down : 0);
    b.x0 = w.x0[i] / kSide;
    b.y0 = w.y0[i] / kSide;
    b.x1 = (w.x1[i] + kSide - 1) / kSide;
    b.y1 = (w.y1[i] + kSide - 1) / kSide;
    return b;
}

// Blocks are many: those of one triangle side by side.
template <Shows kShows>
HWY_INLINE void draw_large(const TilePlanes& tile, const Walks& w, int i, const BlockList& list,
                           I32& drawn) {
    WalkLanes lanes = walk_lanes(w, [&](const double* from) HWY_ATTR { return F64x8(from[i]); });
    lanes.x0 = w.x0[i];
    lanes.y0 = w.y0[i];
    lanes.x1 = w.x1[i];
    lanes.y1 = w.y1[i];
    for (int k = 0; k < list.count; k += kLanesX8) {
        const int left = list.count - k;
        const std::uint32_t live = left < kLanesX8 ? (1U << left) - 1 : (1U << kLanesX8) - 1;
        const AtBlocks blocks =
            at_blocks(tile, lanes, load<I32x8>(list.x + k), load<I32x8>(list.y + k));
        draw_flat<kShows, true>(tile, lanes, blocks, live, w.id + i, drawn);
    }
}

// A block of a triangle that is not flat: depth by its edge functions at every sample, in double.
template <Shows kShows>
HWY_INLINE void draw_steep(const TilePlanes& tile, const Walks& w, int i, std::uint32_t id, int bx,
                           int by, I32& drawn) {
    constexpr int kSide = BlockWalk::kSide;
    const double x = (tile.area.x0 + bx * kSide) * kSubpixel;
    const double y = (tile.area.y0 + by * kSide) * kSubpixel;
    double corner[3];
    F64x8 share[3];
    for (int k = 0; k < 3; ++k) {
        corner[k] = (w.a[k][i] * x + w.b[k][i] * y) + w.c[k][i];
        share[k] = w.share[k][i];
    }
    const int begin = w.y0[i] > by * kSide ? w.y0[i] : by * kSide;
    const int end = w.y1[i] < (by + 1) * kSide ? w.y1[i] : (by + 1) * kSide;
    I32x8 here = 0;
    for (std::size_t s = 0; s < tile.pattern.size(); ++s) {
        const SampleOffset at = tile.pattern.data()[s];
        for (int row = begin; row < end; ++row)
            for (int column = 0; column < kSide; column += kLanesX8) {
                const F64x8 pixel = to_f64(iota<I32x8>(column));
                F64x8 e[3];
                const auto edge = [&](int k) HWY_ATTR {
                    const double a = w.a[k][i], b = w.b[k][i];
                    const double start =
                        (corner[k] + (a * at.x + b * at.y)) + b * kSubpixel * (row - by * kSide);
                    return F64x8(start) + pixel * F64x8(a * kSubpixel);
                };
                SIMD_UNROLL
                for (int k = 0; k < 3; ++k)
                    e[k] = edge(k);
                const F32x8 z = to_f32(depth_of(e, share));
                const auto covers = [&](int k) HWY_ATTR {
                    return e[k] + F64x8(w.bias[k][i]) >= F64x8(0.0);
                };
                const auto inside =
                    select(covers(0) & covers(1) & covers(2), F64x8(1.0), F64x8(0.0));
                const std::ptrdiff_t first =
                    static_cast<std::ptrdiff_t>(s) * kTileSize * kTileSize + row * kTileSize +
                    (bx * kSide + column);
                show_samples<kShows>(tile.rule, to_f32(inside) > F32x8(0.5F), z, id,
                                     tile.depth + first, id_after<kShows>(tile.id, first), here);
            }
    }
    if (any(!(here == I32x8(0)))) drawn = I32(-1);
}

template <Shows kShows>
HWY_INLINE bool draw_all(const TilePlanes& tile, const SampleExtent& extent,
                         const TriangleList& list) {
    constexpr std::uint32_t kRegister = (1U << kLanesX8) - 1;
    I32 drawn = 0;
    Walks w;
    BlockList blocks;
    const auto all = static_cast<int>(list.which.size());
    for (int begin = 0; begin < all; begin += Walks::kRoom) {
        const int count = all - begin < Walks::kRoom ? all - begin : Walks::kRoom;
        load_corners(list, begin, count, w);
        set_up(tile, extent, list.vertices.data(), count, w);
        const std::uint32_t small = w.live & w.flat & w.small;
        for (int i = 0; i < Walks::kRoom; i += kLanesX8)
            draw_small<kShows>(tile, w, i, small >> i & kRegister, drawn);
        for (std::uint32_t rest = w.live & ~small; rest != 0; rest &= rest - 1) {
            const int i = __builtin_ctz(rest);
            find_blocks<is_usual(kShows)>(tile, bounds_of(tile, w, i), blocks);
            if ((w.flat >> i & 1) != 0) {
                draw_large<kShows>(tile, w, i, blocks, drawn);
                continue;
            }
            for (int k = 0; k < blocks.count; ++k)
                draw_steep<kShows>(tile, w, i, w.id[i], blocks.x[k], blocks.y[k], drawn);
        }
    }
    return any(!(drawn == I32(0)));
}

bool draw_usual(const TilePlanes& tile, const SampleExtent& extent, const TriangleList& list) {
    return draw_all<Shows::usual>(tile, extent, list);
}
bool draw_depth(const TilePlanes& tile, const SampleExtent& extent, const TriangleList& list) {
    return draw_all<Shows::depth>(tile, extent, list);
}
bool draw_by_rule(const TilePlanes& tile, const SampleExtent& extent, const TriangleList& list) {
    return draw_all<Shows::by_rule>(tile, extent, list);
}

bool flat_alone(const ScreenVertex* corners) {
    Walks w;
    for (int i = 0; i < Walks::kRoom; ++i)
        for (int k = 0; k < 3; ++k)
            w.corner[k][i] = static_cast<std::uint32_t>(k);
    set_up({{0, 0, kTileSize, kTileSize}, {}, nullptr, nullptr}, {}, corners, 1, w);
    return (w.flat & 1) != 0;
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(draw_usual);
SIMD_REGISTER(draw_depth);
SIMD_REGISTER(draw_by_rule);
SIMD_REGISTER(flat_alone);

bool draw_triangles(const TilePlanes& tile, const TriangleList& triangles) {
    const SampleExtent extent = extent_of(tile.pattern);
    if (!tile.rule.usual()) return SIMD_CALL(draw_by_rule)(tile, extent, triangles);
    return tile.id == nullptr ? SIMD_CALL(draw_depth)(tile, extent, triangles)
                              : SIMD_CALL(draw_usual)(tile, extent, triangles);
}

bool near_to_flat(const SnappedTriangle& triangle) {
    return SIMD_CALL(flat_alone)(triangle.corner.data());
}

} // namespace scanout::raster
#endif
