#include "raster/coverage/coverage.h"

#define SIMD_FILE "raster/coverage/coverage.cpp"
#include "simd/for_each_target.h"

#include "raster/coverage/large_blocks-inl.h"

SIMD_BEGIN(scanout::raster)

// Triangles of few blocks: several triangles side by side, block after block. Saves 3 % of a frame
// of the teapot (6320 triangles, 960 x 540) in instructions.
template <DepthWrite kWrite>
SIMD_INLINE void draw_few_blocks(const TilePlanes& tile, const TriangleSetup& w, int i,
                                 std::uint32_t live, I32& drawn) {
    SetupLanes lanes =
        setup_lanes(w, [&](const double* from) SIMD_LAMBDA { return load<F64x8>(from + i); });
    lanes.x0 = load<I32x8>(w.x0 + i);
    lanes.y0 = load<I32x8>(w.y0 + i);
    lanes.x1 = load<I32x8>(w.x1 + i);
    lanes.y1 = load<I32x8>(w.y1 + i);
    const I32x8 x0 = shift_right<3>(lanes.x0), x1 = shift_right<3>(lanes.x1 + 7);
    const I32x8 y1 = shift_right<3>(lanes.y1 + 7);
    I32x8 x = x0, y = shift_right<3>(lanes.y0);
    while (live != 0) {
        const AtBlocks blocks = at_blocks(tile, lanes, x, y);
        const std::uint32_t visible = visible_lanes<is_default(kWrite)>(tile, lanes, blocks, live);
        if (visible != 0)
            draw_float_depth_blocks<kWrite>(tile, lanes, blocks, visible, w.id + i, drawn);
        x = x + 1;
        const MaskX8 next = x >= x1;
        x = select(next, x0, x);
        y = select(next, y + 1, y);
        live &= bits(y < y1);
    }
}

// BlockBounds of triangles, one a lane.
struct BoundsLanes {
    float edge[3][TriangleSetup::kTriangles], across[3][TriangleSetup::kTriangles],
        down[3][TriangleSetup::kTriangles];
    float depth[TriangleSetup::kTriangles], depth_across[TriangleSetup::kTriangles],
        depth_down[TriangleSetup::kTriangles];
    float most[TriangleSetup::kTriangles];
};

// Returns the triangles of which some block may be visible. farthest: nothing in the tile is
// farther away.
SIMD_INLINE std::uint32_t bounds_of(const TilePlanes& tile, const TriangleSetup& w, float farthest,
                                    BoundsLanes& out) {
    constexpr int kSide = PixelBlock::kSide;
    const F64x8 block = double{kSide * kSubpixel}, margin = BlockBounds::kMargin, zero = 0.0;
    const F64x8 corner_x = static_cast<double>(tile.area.x0 * kSubpixel),
                corner_y = static_cast<double>(tile.area.y0 * kSubpixel);
    // From the tile's first block to where it is greatest.
    const auto highest = [&](F64x8 first, F64x8 across, F64x8 down) SIMD_LAMBDA {
        return first +
               (maximum(across, zero) + maximum(down, zero)) * F64x8(double{BlockList::kRow});
    };
    std::uint32_t visible = 0;
    for (int i = 0; i < TriangleSetup::kTriangles; i += kLanesX8) {
        const auto read = [&](const double* from) SIMD_LAMBDA { return load<F64x8>(from + i); };
        F64x8 depth = 0.0;
        auto here = read(w.nearest) >= F64x8(double{farthest}) * F64x8(1 - 0x1p-20);
        SIMD_FOR (int k = 0; k < 3; ++k) {
            const F64x8 a = read(w.a[k]), b = read(w.b[k]), high = read(w.highest[k]);
            const F64x8 corner = (a * corner_x + b * corner_y) + read(w.c[k]);
            const F64x8 across = a * block, down = b * block;
            const F64x8 terms = (abs(corner) + abs(high)) +
                                F64x8(double{BlockList::kRow}) * (abs(across) + abs(down));
            const F64x8 edge = (corner + high) + terms * margin;
            depth = depth + (corner + terms * margin) * read(w.depth_factor[k]);
            here = here & (highest(edge, across, down) >= zero);
            store(to_f32(edge), out.edge[k] + i);
            store(to_f32(across), out.across[k] + i);
            store(to_f32(down), out.down[k] + i);
        }
        const F64x8 across = read(w.per_x) * F64x8(double{kSide}),
                    down = read(w.per_y) * F64x8(double{kSide});
        depth = depth + (maximum(across, zero) + maximum(down, zero));
        here = here & (highest(depth, across, down) >= F64x8(double{farthest}));
        store(to_f32(depth), out.depth + i);
        store(to_f32(across), out.depth_across + i);
        store(to_f32(down), out.depth_down + i);
        store(to_f32(read(w.nearest) * F64x8(1 + 0x1p-20)), out.most + i);
        visible |= bits(here) << i;
    }
    return visible;
}

SIMD_INLINE BlockBounds bounds_at(const TriangleSetup& w, const BoundsLanes& lanes, int i) {
    constexpr int kSide = PixelBlock::kSide;
    BlockBounds b;
    SIMD_FOR (int k = 0; k < 3; ++k) {
        b.edge[k] = lanes.edge[k][i];
        b.across[k] = lanes.across[k][i];
        b.down[k] = lanes.down[k][i];
    }
    b.depth = lanes.depth[i];
    b.depth_across = lanes.depth_across[i];
    b.depth_down = lanes.depth_down[i];
    b.most = lanes.most[i];
    b.x0 = w.x0[i] / kSide;
    b.y0 = w.y0[i] / kSide;
    b.x1 = (w.x1[i] + kSide - 1) / kSide;
    b.y1 = (w.y1[i] + kSide - 1) / kSide;
    return b;
}

// Triangles of many blocks: several blocks of one triangle side by side. large: a bit for each.
template <DepthWrite kWrite>
SIMD_INLINE void draw_many_blocks(const TilePlanes& tile, const TriangleSetup& w,
                                  std::uint32_t large, I32& drawn) {
    const bool use_hi_z = is_default(kWrite) && tile.hi_z != nullptr;
    BoundsLanes bounds;
    for (large &= bounds_of(tile, w, use_hi_z ? far_depth_of_tile(tile) : 0.0F, bounds); large != 0;
         large &= large - 1) {
        const int i = __builtin_ctz(large);
        std::uint64_t blocks =
            reject_blocks<is_default(kWrite)>(tile, bounds_at(w, bounds, i), nullptr);
        if ((w.float_depth >> i & 1) != 0) {
            draw_large<kWrite>(tile, w, i, blocks, drawn);
            continue;
        }
        for (; blocks != 0; blocks &= blocks - 1)
            draw_double_depth_block<kWrite>(tile, w, i, __builtin_ctzll(blocks), drawn);
    }
}

template <DepthWrite kWrite>
SIMD_INLINE bool draw_all(const TilePlanes& tile, const SampleExtent& extent,
                          const TriangleList& list) {
    constexpr std::uint32_t kRegister = (1U << kLanesX8) - 1;
    I32 drawn = 0;
    TriangleSetup w;
    const auto all = static_cast<int>(list.which.size());
    for (int begin = 0; begin < all; begin += TriangleSetup::kTriangles) {
        const int count =
            all - begin < TriangleSetup::kTriangles ? all - begin : TriangleSetup::kTriangles;
        load_vertices(list, begin, count, w);
        set_up(tile, extent, list.vertices.data(), count, w);
        const std::uint32_t small = w.live & w.float_depth & w.small;
        for (int i = 0; i < TriangleSetup::kTriangles; i += kLanesX8)
            draw_few_blocks<kWrite>(tile, w, i, small >> i & kRegister, drawn);
        if (w.live != small) draw_many_blocks<kWrite>(tile, w, w.live & ~small, drawn);
    }
    return any(!(drawn == I32(0)));
}

bool draw_nearest(const TilePlanes& tile, const SampleExtent& extent, const TriangleList& list) {
    return draw_all<DepthWrite::nearest>(tile, extent, list);
}
bool draw_depth(const TilePlanes& tile, const SampleExtent& extent, const TriangleList& list) {
    return draw_all<DepthWrite::depth_only>(tile, extent, list);
}
bool draw_by_rule(const TilePlanes& tile, const SampleExtent& extent, const TriangleList& list) {
    return draw_all<DepthWrite::by_rule>(tile, extent, list);
}

bool has_float_depth_alone(const ScreenVertex* corners) {
    TriangleSetup w;
    for (int i = 0; i < TriangleSetup::kTriangles; ++i)
        for (int k = 0; k < 3; ++k)
            w.vertex[k][i] = static_cast<std::uint32_t>(k);
    set_up({{0, 0, kTileSize, kTileSize}, {}, nullptr, nullptr}, {}, corners, 1, w);
    return (w.float_depth & 1) != 0;
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(draw_nearest);
SIMD_REGISTER(draw_depth);
SIMD_REGISTER(draw_by_rule);
SIMD_REGISTER(has_float_depth_alone);

bool draw_triangles(const TilePlanes& tile, const TriangleList& triangles) {
    const SampleExtent extent = extent_of(tile.pattern);
    if (!tile.rule.is_default()) return SIMD_CALL(draw_by_rule, tile, extent, triangles);
    return tile.id == nullptr ? SIMD_CALL(draw_depth, tile, extent, triangles)
                              : SIMD_CALL(draw_nearest, tile, extent, triangles);
}

bool has_float_depth(const SnappedTriangle& triangle) {
    return SIMD_CALL(has_float_depth_alone, triangle.vertex.data());
}

} // namespace scanout::raster
#endif
