#include "raster/coverage.h"

#include "raster/block_walk.h"

#define SIMD_FILE "raster/coverage.cpp"
#include "simd/for_each_target.h"

#include "raster/show-inl.h"

SIMD_BEGIN(scanout::raster)

// Several triangles side by side: their vertices, then what the walk over their blocks reads.
struct Walks {
    static constexpr int kRoom = 8;
    double x[3][kRoom], y[3][kRoom], depth[3][kRoom]; // 1/256 pixel
    // Edge functions a x + b y + c, positive inside, opposite vertex i; whole numbers and exact,
    // |E| < 2^50. bias: 0 or -1, the top-left rule: inside iff E + bias >= 0.
    double a[3][kRoom], b[3][kRoom], c[3][kRoom], bias[3][kRoom];
    // How far E + bias may lie below and above E at a block's corner.
    double lowest[3][kRoom], highest[3][kRoom];
    double share[3][kRoom], per_x[kRoom], per_y[kRoom];      // DepthPlane
    std::int32_t x0[kRoom], y0[kRoom], x1[kRoom], y1[kRoom]; // pixels of the tile that it may touch
    std::uint32_t live, flat;                                // bit i: triangle i
};

struct Corner {
    F64x8 key, x, y, depth;
};

// The canonical order of vertices: lowest y first, then lowest x.
HWY_INLINE void sort_two(Corner& a, Corner& b) {
    const auto turn = b.key < a.key;
    const auto swap = [&](F64x8& one, F64x8& other) {
        const F64x8 first = select(turn, other, one);
        other = select(turn, one, other);
        one = first;
    };
    swap(a.key, b.key);
    swap(a.x, b.x);
    swap(a.y, b.y);
    swap(a.depth, b.depth);
}

HWY_INLINE void set_up_bounds(const Corner (&v)[3], const TilePlanes& tile,
                              const SampleExtent& extent, Walks& w, int i) {
    // The first and the last pixel whose samples, between low and high, may lie in [min, max].
    const auto first = [](F64x8 least, std::int32_t high) {
        return shift_right<kSubpixelBits>(to_i32(least) + I32x8(kSubpixel - 1 - high));
    };
    const auto end = [](F64x8 most, std::int32_t low) {
        return shift_right<kSubpixelBits>(to_i32(most) + I32x8(kSubpixel - low));
    };
    const F64x8 min_x = minimum(minimum(v[0].x, v[1].x), v[2].x);
    const F64x8 max_x = maximum(maximum(v[0].x, v[1].x), v[2].x);
    const auto& area = tile.area;
    store(maximum(first(min_x, extent.high.x) - I32x8(area.x0), 0), w.x0 + i);
    store(maximum(first(v[0].y, extent.high.y) - I32x8(area.y0), 0), w.y0 + i);
    store(minimum(end(max_x, extent.low.x), area.x1) - I32x8(area.x0), w.x1 + i);
    store(minimum(end(v[2].y, extent.low.y), area.y1) - I32x8(area.y0), w.y1 + i);
}

// The depth plane, and which of the lanes are near to flat (coverage.h).
HWY_INLINE std::uint32_t set_up_depth(const Corner (&v)[3], const F64x8 (&a)[3],
                                      const F64x8 (&b)[3], F64x8 area, Walks& w, int i) {
    F64x8 share[3], terms = 0.0; // what may cancel in the sums below, across a block
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        share[k] = v[k].depth / area;
        terms = terms + (abs(a[k]) + abs(b[k])) * share[k];
        store(share[k], w.share[k] + i);
    }
    const auto gradient = [&](const F64x8(&step)[3]) {
        return ((step[0] * share[0] + step[1] * share[1]) + step[2] * share[2]) * F64x8(kSubpixel);
    };
    const F64x8 per_x = gradient(a), per_y = gradient(b);
    store(per_x, w.per_x + i);
    store(per_y, w.per_y + i);
    const F64x8 least = minimum(minimum(v[0].depth, v[1].depth), v[2].depth);
    constexpr double kBlock = BlockWalk::kSide;
    return bits((least >= F64x8(0x1p-100)) &
                (F64x8(kBlock) * (abs(per_x) + abs(per_y)) <= least / F64x8(32.0)) &
                (F64x8(kBlock * kSubpixel) * terms <= least * F64x8(0x1p20)));
}

HWY_INLINE void set_up_edges(const F64x8 (&a)[3], const F64x8 (&b)[3], const Corner (&v)[3],
                             const SampleExtent& extent, Walks& w, int i) {
    constexpr double kAcross = (BlockWalk::kSide - 1) * kSubpixel;
    const F64x8 left = static_cast<double>(extent.low.x), top = static_cast<double>(extent.low.y);
    const F64x8 right = kAcross + extent.high.x, bottom = kAcross + extent.high.y;
    const F64x8 zero = 0.0;
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        const int from = k == 2 ? 0 : k + 1;
        // y runs down: a left edge has its interior towards +x, a top edge towards +y.
        const auto top_left = (a[k] > zero) | ((a[k] == zero) & (b[k] > zero));
        const F64x8 bias = select(top_left, zero, F64x8(-1.0));
        const auto leans_left = a[k] < zero, leans_up = b[k] < zero;
        store(a[k], w.a[k] + i);
        store(b[k], w.b[k] + i);
        store(-(a[k] * v[from].x + b[k] * v[from].y), w.c[k] + i);
        store(bias, w.bias[k] + i);
        store((bias + a[k] * select(leans_left, right, left)) +
                  b[k] * select(leans_up, bottom, top),
              w.lowest[k] + i);
        store((bias + a[k] * select(leans_left, left, right)) +
                  b[k] * select(leans_up, top, bottom),
              w.highest[k] + i);
    }
}

// Every operation on coordinates is exact: the rest is the plane of depth.
HWY_INLINE void set_up(const TilePlanes& tile, const SampleExtent& extent, Walks& w) {
    w.live = w.flat = 0;
    for (int i = 0; i < Walks::kRoom; i += kLanesX8) {
        Corner v[3];
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k) {
            v[k] = {
                {}, load<F64x8>(w.x[k] + i), load<F64x8>(w.y[k] + i), load<F64x8>(w.depth[k] + i)};
            v[k].key = v[k].y * F64x8(0x1p26) + v[k].x; // |x| < 2^25
        }
        sort_two(v[0], v[1]);
        sort_two(v[1], v[2]);
        sort_two(v[0], v[1]);
        const F64x8 twice =
            (v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[1].y - v[0].y) * (v[2].x - v[0].x);
        const F64x8 sign = select(twice < F64x8(0.0), F64x8(-1.0), F64x8(1.0));
        const auto some = abs(twice) > F64x8(0.0); // what has no area covers no sample
        const F64x8 area = select(some, abs(twice), F64x8(1.0));
        F64x8 a[3], b[3];
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k) {
            const Corner &from = v[k == 2 ? 0 : k + 1], &to = v[k == 0 ? 2 : k - 1];
            a[k] = sign * (from.y - to.y);
            b[k] = sign * (to.x - from.x);
        }
        set_up_edges(a, b, v, extent, w, i);
        set_up_bounds(v, tile, extent, w, i);
        w.flat |= set_up_depth(v, a, b, area, w, i) << i;
        const MaskX8 touches = (load<I32x8>(w.x0 + i) < load<I32x8>(w.x1 + i)) &
                               (load<I32x8>(w.y0 + i) < load<I32x8>(w.y1 + i));
        w.live |= (bits(some) & bits(touches)) << i;
    }
}

// A block's rows at the samples of one place in the pattern.
struct Rows {
    std::int32_t first[3];           // floor((E + bias) / 256) at the block's first pixel
    std::int32_t per_x[3], per_y[3]; // 0 where the edge holds for the whole block
    float sample_x, sample_y;        // pixels, from a pixel's corner
    float base, rest, per_pixel_x, per_pixel_y;                  // flat depth
    double edge[3], edge_per_x[3], edge_per_y[3], edge_share[3]; // E itself; the other path
};

template <bool kFlat, bool kUsual>
HWY_INLINE void draw_rows(const VisibleRule& rule, const Rows& rows, std::uint32_t primitive,
                          int begin, int end, float* depth, std::uint32_t* id, I32x8& drawn) {
    constexpr int kRegisters = BlockWalk::kSide / kLanesX8;
    I32x8 edge[3][kRegisters], down[3];
    F32x8 across[kRegisters];
    SIMD_UNROLL
    for (int r = 0; r < kRegisters; ++r) {
        const I32x8 column = iota<I32x8>(r * kLanesX8);
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            edge[k][r] =
                I32x8(rows.first[k] + rows.per_y[k] * begin) + I32x8(rows.per_x[k]) * column;
        across[r] = (to_f32(column) + F32x8(rows.sample_x)) * F32x8(rows.per_pixel_x);
    }
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        down[k] = I32x8(rows.per_y[k]);
    float* depth_row = depth + begin * kTileSize;
    std::uint32_t* id_row = id + begin * kTileSize;
    for (int y = begin; y < end; ++y, depth_row += kTileSize, id_row += kTileSize) {
        const float down_here = (static_cast<float>(y) + rows.sample_y) * rows.per_pixel_y;
        SIMD_UNROLL
        for (int r = 0; r < kRegisters; ++r) {
            const int x = r * kLanesX8;
            const MaskX8 inside = (edge[0][r] | edge[1][r] | edge[2][r]) >= I32x8(0);
            F32x8 z;
            if constexpr (kFlat) {
                z = F32x8(rows.base) + (F32x8(rows.rest) + (across[r] + F32x8(down_here)));
            } else {
                const F64x8 at = to_f64(iota<I32x8>(x));
                const auto term = [&](int k) {
                    const double start = rows.edge[k] + rows.edge_per_y[k] * y;
                    return (F64x8(start) + at * F64x8(rows.edge_per_x[k])) *
                           F64x8(rows.edge_share[k]);
                };
                z = to_f32((term(0) + term(1)) + term(2));
            }
            if constexpr (kUsual)
                show(inside, z, primitive, depth_row + x, id_row + x, drawn);
            else
                show_by(rule, inside, z, primitive, depth_row + x, id_row + x, drawn);
            SIMD_UNROLL
            for (int k = 0; k < 3; ++k)
                edge[k][r] = edge[k][r] + down[k];
        }
    }
}

template <bool kFlat, bool kUsual>
HWY_INLINE void draw_block(const TilePlanes& tile, const Walks& w, int i, std::uint32_t id, int bx,
                           int by, I32x8& drawn) {
    constexpr int kSide = BlockWalk::kSide;
    const double x = (tile.area.x0 + bx * kSide) * kSubpixel;
    const double y = (tile.area.y0 + by * kSide) * kSubpixel;
    double corner[3];
    bool whole[3];
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        corner[k] = (w.a[k][i] * x + w.b[k][i] * y) + w.c[k][i];
        if (corner[k] + w.highest[k][i] < 0) return;
        whole[k] = corner[k] + w.lowest[k][i] >= 0;
    }
    Rows rows;
    if constexpr (kFlat) {
        const double z =
            (corner[0] * w.share[0][i] + corner[1] * w.share[1][i]) + corner[2] * w.share[2][i];
        rows.base = static_cast<float>(z);
        rows.rest = static_cast<float>(z - static_cast<double>(rows.base));
        rows.per_pixel_x = static_cast<float>(w.per_x[i]);
        rows.per_pixel_y = static_cast<float>(w.per_y[i]);
    }
    const std::size_t plane = std::size_t{kTileSize} * kTileSize;
    const std::size_t first =
        static_cast<std::size_t>(by) * kSide * kTileSize + static_cast<std::size_t>(bx) * kSide;
    const int row0 = w.y0[i] - by * kSide, row1 = w.y1[i] - by * kSide;
    for (std::size_t s = 0; s < tile.pattern.size(); ++s) {
        const SampleOffset at = tile.pattern.data()[s];
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k) {
            const double a = w.a[k][i], b = w.b[k][i];
            const double e = corner[k] + (a * at.x + b * at.y);
            constexpr std::int64_t kMost = std::int64_t{1} << 29;
            const std::int64_t floor = static_cast<std::int64_t>(e + w.bias[k][i]) >> kSubpixelBits;
            const std::int64_t capped = floor < -kMost ? -kMost : (floor > kMost ? kMost : floor);
            rows.first[k] = whole[k] ? 0 : static_cast<std::int32_t>(capped);
            rows.per_x[k] = whole[k] ? 0 : static_cast<std::int32_t>(a);
            rows.per_y[k] = whole[k] ? 0 : static_cast<std::int32_t>(b);
            if constexpr (!kFlat) {
                rows.edge[k] = e;
                rows.edge_per_x[k] = a * kSubpixel;
                rows.edge_per_y[k] = b * kSubpixel;
                rows.edge_share[k] = w.share[k][i];
            }
        }
        rows.sample_x = static_cast<float>(at.x) / kSubpixel;
        rows.sample_y = static_cast<float>(at.y) / kSubpixel;
        draw_rows<kFlat, kUsual>(tile.rule, rows, id, row0 > 0 ? row0 : 0,
                                 row1 < kSide ? row1 : kSide, tile.depth + s * plane + first,
                                 tile.id + s * plane + first, drawn);
    }
}

template <bool kFlat, bool kUsual>
HWY_INLINE void draw_blocks(const TilePlanes& tile, const Walks& w, int i, std::uint32_t id,
                            I32x8& drawn) {
    constexpr int kSide = BlockWalk::kSide;
    for (int by = w.y0[i] / kSide; by * kSide < w.y1[i]; ++by)
        for (int bx = w.x0[i] / kSide; bx * kSide < w.x1[i]; ++bx)
            draw_block<kFlat, kUsual>(tile, w, i, id, bx, by, drawn);
}

// The vertices of at most kRoom triangles; what is missing has no area.
HWY_INLINE void load_vertices(const SnappedTriangle* t, int count, Walks& w) {
    for (int i = 0; i < Walks::kRoom; ++i)
        SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        const ScreenVertex* v = i < count ? t[i].corner.data() + k : nullptr;
        w.x[k][i] = v != nullptr ? v->x : 0;
        w.y[k][i] = v != nullptr ? v->y : 0;
        w.depth[k][i] = v != nullptr ? v->depth : 0;
    }
}

template <bool kUsual>
HWY_INLINE bool draw_all(const TilePlanes& tile, const SampleExtent& extent,
                         const SnappedTriangle* t, int count) {
    I32x8 drawn = 0;
    Walks w;
    for (int begin = 0; begin < count; begin += Walks::kRoom) {
        load_vertices(t + begin, count - begin, w);
        set_up(tile, extent, w);
        for (std::uint32_t live = w.live; live != 0; live &= live - 1) {
            const int i = __builtin_ctz(live);
            if ((w.flat >> i & 1) != 0)
                draw_blocks<true, kUsual>(tile, w, i, t[begin + i].id, drawn);
            else
                draw_blocks<false, kUsual>(tile, w, i, t[begin + i].id, drawn);
        }
    }
    return any(!(drawn == I32x8(0)));
}

bool draw_usual(const TilePlanes& tile, const SampleExtent& extent, const SnappedTriangle* t,
                int count) {
    return draw_all<true>(tile, extent, t, count);
}
bool draw_by_rule(const TilePlanes& tile, const SampleExtent& extent, const SnappedTriangle* t,
                  int count) {
    return draw_all<false>(tile, extent, t, count);
}

bool flat_alone(const SnappedTriangle& t) {
    Walks w;
    load_vertices(&t, 1, w);
    set_up({{0, 0, kTileSize, kTileSize}, {}, nullptr, nullptr}, {}, w);
    return (w.flat & 1) != 0;
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(draw_usual);
SIMD_REGISTER(draw_by_rule);
SIMD_REGISTER(flat_alone);

bool draw_triangles(const TilePlanes& tile, std::span<const SnappedTriangle> triangles) {
    const SampleExtent extent = extent_of(tile.pattern);
    const auto count = static_cast<int>(triangles.size());
    return tile.rule.usual() ? SIMD_CALL(draw_usual)(tile, extent, triangles.data(), count)
                             : SIMD_CALL(draw_by_rule)(tile, extent, triangles.data(), count);
}

bool near_to_flat(const SnappedTriangle& triangle) {
    return SIMD_CALL(flat_alone)(triangle);
}

} // namespace scanout::raster
#endif
