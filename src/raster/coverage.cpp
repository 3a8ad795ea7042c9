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
    std::uint32_t live, flat, small; // bit i: triangle i; small: it touches four blocks at most
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
    w.live = w.flat = w.small = 0;
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
        const auto blocks = [&](const std::int32_t* from, const std::int32_t* to) HWY_ATTR {
            return shift_right<3>(load<I32x8>(to + i) + 7) - shift_right<3>(load<I32x8>(from + i));
        };
        w.small |= bits(blocks(w.x0, w.x1) * blocks(w.y0, w.y1) <= I32x8(4)) << i;
    }
}

template <bool kUsual>
HWY_INLINE void show_row(const VisibleRule& rule, MaskX8 inside, F32x8 z, std::uint32_t primitive,
                         float* depth, std::uint32_t* id, I32x8& drawn) {
    if constexpr (kUsual)
        show(inside, z, primitive, depth, id, drawn);
    else
        show_by(rule, inside, z, primitive, depth, id, drawn);
}

constexpr int kRegisters = BlockWalk::kSide / kLanesX8; // of a row of a block

// What walks in lanes read of Walks: of several triangles, or of one in all lanes.
struct WalkLanes {
    F64x8 a[3], b[3], c[3], bias[3], lowest[3], highest[3], share[3], per_x, per_y;
    I32x8 y0, y1;
};
template <class Read>
HWY_INLINE WalkLanes walk_lanes(const Walks& w, const Read& read) {
    WalkLanes lanes;
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        lanes.a[k] = read(w.a[k]);
        lanes.b[k] = read(w.b[k]);
        lanes.c[k] = read(w.c[k]);
        lanes.bias[k] = read(w.bias[k]);
        lanes.lowest[k] = read(w.lowest[k]);
        lanes.highest[k] = read(w.highest[k]);
        lanes.share[k] = read(w.share[k]);
    }
    lanes.per_x = read(w.per_x);
    lanes.per_y = read(w.per_y);
    return lanes;
}

// Blocks of flat triangles, one a lane, at the samples of one place in the pattern.
struct Blocks {
    // floor((E + bias) / 256) at the first pixel of row `begin`, and its steps: 0 where the edge
    // holds for the whole block.
    std::int32_t first[3][kLanesX8], per_x[3][kLanesX8], per_y[3][kLanesX8];
    std::int32_t begin[kLanesX8], end[kLanesX8]; // rows
    std::int32_t place[kLanesX8];                // of the first pixel, in a plane of the tile
    // Depth at the block's corner: base + rest; its steps a pixel.
    float base[kLanesX8], rest[kLanesX8], per_pixel_x[kLanesX8], per_pixel_y[kLanesX8];
};

template <bool kUsual>
HWY_INLINE void draw_rows(const VisibleRule& rule, const Blocks& b, int lane, SampleOffset at,
                          std::uint32_t primitive, float* depth, std::uint32_t* id, I32x8& drawn) {
    const F32x8 sample_x = static_cast<float>(at.x) / kSubpixel;
    const float sample_y = static_cast<float>(at.y) / kSubpixel;
    const F32x8 base = b.base[lane], rest = b.rest[lane], per_pixel_x = b.per_pixel_x[lane];
    I32x8 edge[3][kRegisters], down[3];
    F32x8 across[kRegisters];
    SIMD_UNROLL
    for (int r = 0; r < kRegisters; ++r) {
        const I32x8 column = iota<I32x8>(r * kLanesX8);
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            edge[k][r] = I32x8(b.first[k][lane]) + I32x8(b.per_x[k][lane]) * column;
        across[r] = (to_f32(column) + sample_x) * per_pixel_x;
    }
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        down[k] = I32x8(b.per_y[k][lane]);
    const int begin = b.begin[lane], end = b.end[lane];
    float* depth_row = depth + begin * kTileSize;
    std::uint32_t* id_row = id + begin * kTileSize;
    for (int y = begin; y < end; ++y, depth_row += kTileSize, id_row += kTileSize) {
        const F32x8 down_here = (static_cast<float>(y) + sample_y) * b.per_pixel_y[lane];
        SIMD_UNROLL
        for (int r = 0; r < kRegisters; ++r) {
            const MaskX8 inside = (edge[0][r] | edge[1][r] | edge[2][r]) >= I32x8(0);
            const F32x8 z = base + (rest + (across[r] + down_here));
            show_row<kUsual>(rule, inside, z, primitive, depth_row + r * kLanesX8,
                             id_row + r * kLanesX8, drawn);
            SIMD_UNROLL
            for (int k = 0; k < 3; ++k)
                edge[k][r] = edge[k][r] + down[k];
        }
    }
}

// Their edges at a place in the pattern. Saturates at 2^29 (BlockWalk).
HWY_INLINE void set_up_rows(const WalkLanes& w, const F64x8 (&corner)[3],
                            const Double<F32x8::Tag>::DoubleMask (&whole)[3], SampleOffset at,
                            I32x8 begin, Blocks& out) {
    const F64x8 most = 0x1p29, zero = 0.0, x = double(at.x), y = double(at.y);
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        const F64x8 e = corner[k] + (w.a[k] * x + w.b[k] * y);
        const F64x8 pixels = (e + w.bias[k]) * F64x8(1.0 / kSubpixel);
        const F64x8 near = minimum(maximum(pixels, -most), most);
        const F64x8 cut = to_f64(to_i32(near)); // towards zero
        const F64x8 floor = cut - select(cut > near, F64x8(1.0), zero);
        const I32x8 per_y = to_i32(select(whole[k], zero, w.b[k]));
        store(to_i32(select(whole[k], zero, floor)) + per_y * begin, out.first[k]);
        store(to_i32(select(whole[k], zero, w.a[k])), out.per_x[k]);
        store(per_y, out.per_y[k]);
    }
}

// Draws the blocks (x, y) of the tile, those of `live` lanes. id_of: lane -> primitive.
template <bool kUsual, class IdOf>
HWY_INLINE void draw_flat(const TilePlanes& tile, const WalkLanes& w, I32x8 x, I32x8 y,
                          std::uint32_t live, const IdOf& id_of, I32x8& drawn) {
    constexpr int kSideBits = 3;
    static_assert(BlockWalk::kSide == 1 << kSideBits);
    const I32x8 left = shift_left<kSideBits>(x), top = shift_left<kSideBits>(y);
    const F64x8 corner_x = to_f64(shift_left<kSubpixelBits>(left + I32x8(tile.area.x0)));
    const F64x8 corner_y = to_f64(shift_left<kSubpixelBits>(top + I32x8(tile.area.y0)));
    const F64x8 zero = 0.0;
    F64x8 corner[3];
    Double<F32x8::Tag>::DoubleMask whole[3];
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        corner[k] = (w.a[k] * corner_x + w.b[k] * corner_y) + w.c[k];
        live &= bits(corner[k] + w.highest[k] >= zero);
        whole[k] = corner[k] + w.lowest[k] >= zero;
    }
    if (live == 0) return;
    Blocks b;
    const F64x8 z = (corner[0] * w.share[0] + corner[1] * w.share[1]) + corner[2] * w.share[2];
    const F32x8 base = to_f32(z);
    store(base, b.base);
    store(to_f32(z - to_f64(base)), b.rest);
    store(to_f32(w.per_x), b.per_pixel_x);
    store(to_f32(w.per_y), b.per_pixel_y);
    const I32x8 begin = maximum(w.y0 - top, 0);
    store(begin, b.begin);
    store(minimum(w.y1 - top, BlockWalk::kSide), b.end);
    store(top * I32x8(kTileSize) + left, b.place);
    std::size_t plane = 0;
    for (const SampleOffset* at = tile.pattern.data();
         at != tile.pattern.data() + tile.pattern.size();
         ++at, plane += std::size_t{kTileSize} * kTileSize) {
        set_up_rows(w, corner, whole, *at, begin, b);
        for (std::uint32_t rest = live; rest != 0; rest &= rest - 1) {
            const int lane = __builtin_ctz(rest);
            const std::size_t first = plane + static_cast<std::size_t>(b.place[lane]);
            draw_rows<kUsual>(tile.rule, b, lane, *at, id_of(lane), tile.depth + first,
                              tile.id + first, drawn);
        }
    }
}

// Blocks are few: those of all triangles side by side, one after the other.
template <bool kUsual>
HWY_INLINE void draw_small(const TilePlanes& tile, const Walks& w, int i, std::uint32_t live,
                           const SnappedTriangle* t, I32x8& drawn) {
    WalkLanes lanes =
        walk_lanes(w, [&](const double* from) HWY_ATTR { return load<F64x8>(from + i); });
    lanes.y0 = load<I32x8>(w.y0 + i);
    lanes.y1 = load<I32x8>(w.y1 + i);
    const I32x8 x0 = shift_right<3>(load<I32x8>(w.x0 + i));
    const I32x8 x1 = shift_right<3>(load<I32x8>(w.x1 + i) + 7);
    const I32x8 y1 = shift_right<3>(lanes.y1 + 7);
    const auto id_of = [&](int lane) { return t[i + lane].id; };
    I32x8 x = x0, y = shift_right<3>(lanes.y0);
    while (live != 0) {
        draw_flat<kUsual>(tile, lanes, x, y, live, id_of, drawn);
        x = x + 1;
        const MaskX8 next = x >= x1;
        x = select(next, x0, x);
        y = select(next, y + 1, y);
        live &= bits(y < y1);
    }
}

// Blocks are many: those of a row side by side.
template <bool kUsual>
HWY_INLINE void draw_large(const TilePlanes& tile, const Walks& w, int i, std::uint32_t id,
                           I32x8& drawn) {
    WalkLanes lanes = walk_lanes(w, [&](const double* from) HWY_ATTR { return F64x8(from[i]); });
    lanes.y0 = w.y0[i];
    lanes.y1 = w.y1[i];
    const auto id_of = [&](int) { return id; };
    const int x1 = (w.x1[i] + 7) / 8, y1 = (w.y1[i] + 7) / 8;
    for (int y = w.y0[i] / 8; y < y1; ++y)
        for (int x = w.x0[i] / 8; x < x1; x += kLanesX8) {
            const int blocks = x1 - x < kLanesX8 ? x1 - x : kLanesX8;
            draw_flat<kUsual>(tile, lanes, iota<I32x8>(x), y, (1U << blocks) - 1, id_of, drawn);
        }
}

// A block of a triangle that is not flat: depth by its edge functions at every sample, in double.
template <bool kUsual>
HWY_INLINE void draw_steep(const TilePlanes& tile, const Walks& w, int i, std::uint32_t id, int bx,
                           int by, I32x8& drawn) {
    constexpr int kSide = BlockWalk::kSide;
    const double x = (tile.area.x0 + bx * kSide) * kSubpixel;
    const double y = (tile.area.y0 + by * kSide) * kSubpixel;
    double corner[3];
    for (int k = 0; k < 3; ++k) {
        corner[k] = (w.a[k][i] * x + w.b[k][i] * y) + w.c[k][i];
        if (corner[k] + w.highest[k][i] < 0) return;
    }
    const std::size_t plane = std::size_t{kTileSize} * kTileSize;
    const int begin = w.y0[i] > by * kSide ? w.y0[i] : by * kSide;
    const int end = w.y1[i] < (by + 1) * kSide ? w.y1[i] : (by + 1) * kSide;
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
                const auto term = [&](int k) HWY_ATTR { return e[k] * F64x8(w.share[k][i]); };
                const F32x8 z = to_f32((term(0) + term(1)) + term(2));
                const auto covers = [&](int k) HWY_ATTR {
                    return e[k] + F64x8(w.bias[k][i]) >= F64x8(0.0);
                };
                const auto inside =
                    select(covers(0) & covers(1) & covers(2), F64x8(1.0), F64x8(0.0));
                const std::size_t first = s * plane + static_cast<std::size_t>(row * kTileSize) +
                                          static_cast<std::size_t>(bx * kSide + column);
                show_row<kUsual>(tile.rule, to_f32(inside) > F32x8(0.5F), z, id, tile.depth + first,
                                 tile.id + first, drawn);
            }
    }
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
    constexpr std::uint32_t kRegister = (1U << kLanesX8) - 1;
    I32x8 drawn = 0;
    Walks w;
    for (int begin = 0; begin < count; begin += Walks::kRoom) {
        load_vertices(t + begin, count - begin, w);
        set_up(tile, extent, w);
        const std::uint32_t small = w.live & w.flat & w.small;
        for (int i = 0; i < Walks::kRoom; i += kLanesX8)
            draw_small<kUsual>(tile, w, i, small >> i & kRegister, t + begin, drawn);
        for (std::uint32_t rest = w.live & ~small; rest != 0; rest &= rest - 1) {
            const int i = __builtin_ctz(rest);
            const std::uint32_t id = t[begin + i].id;
            if ((w.flat >> i & 1) != 0) {
                draw_large<kUsual>(tile, w, i, id, drawn);
                continue;
            }
            for (int by = w.y0[i] / 8; by * 8 < w.y1[i]; ++by)
                for (int bx = w.x0[i] / 8; bx * 8 < w.x1[i]; ++bx)
                    draw_steep<kUsual>(tile, w, i, id, bx, by, drawn);
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
