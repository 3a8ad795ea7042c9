#include "raster/coverage.h"

#include "raster/block_walk.h"

#define SIMD_FILE "raster/coverage.cpp"
#include "simd/for_each_target.h"

#include "raster/show-inl.h"

SIMD_BEGIN(scanout::raster)

// Several triangles side by side: what the walk over their blocks reads.
struct Walks {
    static constexpr int kRoom = 8;
    std::uint32_t corner[3][kRoom]; // vertices
    std::uint32_t id[kRoom];
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

// At most kRoom triangles from number `begin` of the list on; the last stands for what is missing.
HWY_INLINE void load_corners(const TriangleList& list, int begin, int count, Walks& w) {
    for (int i = 0; i < Walks::kRoom; ++i) {
        const int at = begin + (i < count ? i : count - 1);
        const std::uint32_t* index = list.index.data() + std::size_t{list.which.data()[at]} * 3;
        w.id[i] = list.id.data()[at];
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            w.corner[k][i] = index[k];
    }
}

HWY_INLINE Corner corner_of(const ScreenVertex* vertices, I32x8 at) {
    static_assert(sizeof(ScreenVertex) == 16);
    const auto* whole = reinterpret_cast<const std::int32_t*>(vertices);
    const auto* real = reinterpret_cast<const double*>(vertices);
    const I32x8 word = shift_left<2>(at);
    Corner c;
    c.x = to_f64(gather(whole, word));
    c.y = to_f64(gather(whole + 1, word));
    c.depth = gather(real + 1, shift_left<1>(at));
    c.key = c.y * F64x8(0x1p26) + c.x; // |x| < 2^25
    return c;
}

// Every operation on coordinates is exact: the rest is the plane of depth. count: of the lanes.
HWY_INLINE void set_up(const TilePlanes& tile, const SampleExtent& extent,
                       const ScreenVertex* vertices, int count, Walks& w) {
    w.live = w.flat = w.small = 0;
    for (int i = 0; i < Walks::kRoom; i += kLanesX8) {
        Corner v[3];
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            v[k] = corner_of(vertices, load<I32x8>(w.corner[k] + i));
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
    w.live &= (2U << (count - 1)) - 1;
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
    I32x8 x0, y0, x1, y1;
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

// A block that the triangle covers whole, by the usual rule: the same bits as draw_rows.
HWY_INLINE void draw_whole(const Blocks& b, int lane, SampleOffset at, std::uint32_t primitive,
                           float* depth, std::uint32_t* id, I32x8& drawn) {
    const F32x8 sample_x = static_cast<float>(at.x) / kSubpixel;
    const float sample_y = static_cast<float>(at.y) / kSubpixel;
    const F32x8 base = b.base[lane], rest = b.rest[lane], per_pixel_x = b.per_pixel_x[lane];
    F32x8 across[kRegisters];
    SIMD_UNROLL
    for (int r = 0; r < kRegisters; ++r)
        across[r] = (to_f32(iota<I32x8>(r * kLanesX8)) + sample_x) * per_pixel_x;
    const MaskX8 inside = I32x8(0) == I32x8(0);
    float row = sample_y;
    for (int y = 0; y < BlockWalk::kSide; ++y, row += 1.0F, depth += kTileSize, id += kTileSize) {
        const F32x8 down_here = row * b.per_pixel_y[lane];
        SIMD_UNROLL
        for (int r = 0; r < kRegisters; ++r)
            show(inside, base + (rest + (across[r] + down_here)), primitive, depth + r * kLanesX8,
                 id + r * kLanesX8, drawn);
    }
}

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

// Pixels of a block that a triangle's box leaves: few of them are drawn one by one, with a triangle
// a lane, not row by row.
constexpr int kFew = 3;
struct Few {
    std::uint32_t lanes; // of which this holds
    I32x8 column, across, down;
};
HWY_INLINE Few few_pixels(const WalkLanes& w, I32x8 left, I32x8 begin, I32x8 end,
                          std::uint32_t live) {
    const I32x8 column = maximum(w.x0 - left, 0);
    const I32x8 across = minimum(w.x1 - left, BlockWalk::kSide) - column, down = end - begin;
    return {bits((across <= I32x8(kFew)) & (down <= I32x8(kFew))) & live, column, across, down};
}

// The same bits as draw_rows, by the usual rule.
HWY_INLINE void draw_few(const Blocks& b, const Few& few, SampleOffset at,
                         const std::uint32_t* name, float* depth, std::uint32_t* id, I32x8& drawn) {
    const F32x8 sample_x = static_cast<float>(at.x) / kSubpixel;
    const F32x8 sample_y = static_cast<float>(at.y) / kSubpixel;
    const F32x8 base = load<F32x8>(b.base), rest = load<F32x8>(b.rest);
    const F32x8 per_pixel_x = load<F32x8>(b.per_pixel_x), per_pixel_y = load<F32x8>(b.per_pixel_y);
    const I32x8 begin = load<I32x8>(b.begin);
    I32x8 start[3], right[3], below[3];
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        right[k] = load<I32x8>(b.per_x[k]);
        below[k] = load<I32x8>(b.per_y[k]);
        start[k] = load<I32x8>(b.first[k]) + right[k] * few.column;
    }
    std::int32_t corner[kLanesX8];
    store(load<I32x8>(b.place) + begin * I32x8(kTileSize) + few.column, corner);
    bool shows = false;
    for (int j = 0; j < kFew; ++j) {
        const MaskX8 in_row = I32x8(j) < few.down;
        if ((bits(in_row) & few.lanes) == 0) break;
        const F32x8 down_here = (to_f32(begin + j) + sample_y) * per_pixel_y;
        I32x8 edge[3] = {start[0], start[1], start[2]};
        for (int i = 0; i < kFew; ++i) {
            const MaskX8 inside =
                in_row & (I32x8(i) < few.across) & ((edge[0] | edge[1] | edge[2]) >= I32x8(0));
            const F32x8 across = (to_f32(few.column + i) + sample_x) * per_pixel_x;
            float here[kLanesX8];
            store(base + (rest + (across + down_here)), here);
            for (std::uint32_t todo = bits(inside) & few.lanes; todo != 0; todo &= todo - 1) {
                const int lane = __builtin_ctz(todo);
                const std::ptrdiff_t place = corner[lane] + j * kTileSize + i;
                const float z = here[lane], old = depth[place];
                if (z > old || (z == old && name[lane] < id[place])) {
                    depth[place] = z;
                    id[place] = name[lane];
                    shows = true;
                }
            }
            SIMD_UNROLL
            for (int k = 0; k < 3; ++k)
                edge[k] = edge[k] + right[k];
        }
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            start[k] = start[k] + below[k];
    }
    if (shows) drawn = I32x8(-1);
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

// Blocks (x, y) of the tile, one a lane, and what a triangle is at their corners.
struct AtBlocks {
    I32x8 left, top; // pixels in the tile
    F64x8 edge[3], depth;
};
HWY_INLINE AtBlocks at_blocks(const TilePlanes& tile, const WalkLanes& w, I32x8 x, I32x8 y) {
    constexpr int kSideBits = 3;
    static_assert(BlockWalk::kSide == 1 << kSideBits);
    AtBlocks at;
    at.left = shift_left<kSideBits>(x);
    at.top = shift_left<kSideBits>(y);
    const F64x8 corner_x = to_f64(shift_left<kSubpixelBits>(at.left + I32x8(tile.area.x0)));
    const F64x8 corner_y = to_f64(shift_left<kSubpixelBits>(at.top + I32x8(tile.area.y0)));
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        at.edge[k] = (w.a[k] * corner_x + w.b[k] * corner_y) + w.c[k];
    at.depth = (at.edge[0] * w.share[0] + at.edge[1] * w.share[1]) + at.edge[2] * w.share[2];
    return at;
}

// Depth over a block is depth at its corner and up to this, each way; 2^-20 of it is far more than
// all that is rounded on the way.
struct Reach {
    F64x8 back, front;
};
HWY_INLINE Reach reach_of(const WalkLanes& w) {
    const F64x8 side = double{BlockWalk::kSide}, zero = 0.0;
    return {(minimum(w.per_x, zero) + minimum(w.per_y, zero)) * side,
            (maximum(w.per_x, zero) + maximum(w.per_y, zero)) * side};
}

// Of the live lanes those whose block the triangle may touch, and not all behind what is there.
template <bool kUsual>
HWY_INLINE std::uint32_t seen(const TilePlanes& tile, const WalkLanes& w, const AtBlocks& at,
                              std::uint32_t live) {
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        live &= bits(at.edge[k] + w.highest[k] >= F64x8(0.0));
    if (!kUsual || live == 0 || tile.farthest == nullptr) return live;
    constexpr int kBlocks = kTileSize / BlockWalk::kSide;
    const I32x8 block = shift_right<3>(at.top) * I32x8(kBlocks) + shift_right<3>(at.left);
    // Lanes that are not live may lie anywhere.
    const I32x8 safe = minimum(maximum(block, 0), kBlocks * kBlocks - 1);
    const F64x8 nearest = (at.depth + reach_of(w).front) * F64x8(1 + 0x1p-20);
    return live & ~bits(to_f32(nearest) < gather(tile.farthest, safe));
}

// The blocks of these lanes are covered whole.
HWY_INLINE void keep_farthest(const TilePlanes& tile, const WalkLanes& w, const AtBlocks& at,
                              const Blocks& b, std::uint32_t lanes) {
    if (tile.farthest == nullptr || lanes == 0) return;
    float depth[kLanesX8];
    store(to_f32((at.depth + reach_of(w).back) * F64x8(1 - 0x1p-20)), depth);
    for (; lanes != 0; lanes &= lanes - 1) {
        const int lane = __builtin_ctz(lanes);
        constexpr int kSide = BlockWalk::kSide;
        float& there = tile.farthest[b.place[lane] / (kTileSize * kSide) * (kTileSize / kSide) +
                                     b.place[lane] % kTileSize / kSide];
        if (depth[lane] > there) there = depth[lane];
    }
}

// Draws the blocks of `live` lanes: of one triangle, or of one a lane, which `id` names.
template <bool kUsual, bool kOne>
HWY_INLINE void draw_flat(const TilePlanes& tile, const WalkLanes& w, const AtBlocks& block,
                          std::uint32_t live, const std::uint32_t* id, I32x8& drawn) {
    const F64x8 zero = 0.0;
    Double<F32x8::Tag>::DoubleMask whole[3];
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        whole[k] = block.edge[k] + w.lowest[k] >= zero;
    const std::uint32_t covered = bits(whole[0]) & bits(whole[1]) & bits(whole[2]) & live;
    Blocks b;
    const F32x8 base = to_f32(block.depth);
    store(base, b.base);
    store(to_f32(block.depth - to_f64(base)), b.rest);
    store(to_f32(w.per_x), b.per_pixel_x);
    store(to_f32(w.per_y), b.per_pixel_y);
    const I32x8 begin = maximum(w.y0 - block.top, 0),
                end = minimum(w.y1 - block.top, BlockWalk::kSide);
    store(begin, b.begin);
    store(end, b.end);
    Few few{0, begin, begin, begin};
    if constexpr (kUsual && !kOne) few = few_pixels(w, block.left, begin, end, live & ~covered);
    store(block.top * I32x8(kTileSize) + block.left, b.place);
    std::size_t plane = 0;
    for (const SampleOffset* at = tile.pattern.data();
         at != tile.pattern.data() + tile.pattern.size();
         ++at, plane += std::size_t{kTileSize} * kTileSize) {
        if (!kUsual || covered != live) set_up_rows(w, block.edge, whole, *at, begin, b);
        if (few.lanes != 0) draw_few(b, few, *at, id, tile.depth + plane, tile.id + plane, drawn);
        for (std::uint32_t rest = live & ~few.lanes; rest != 0; rest &= rest - 1) {
            const int lane = __builtin_ctz(rest);
            const std::size_t first = plane + static_cast<std::size_t>(b.place[lane]);
            const std::uint32_t name = id[kOne ? 0 : lane];
            if (kUsual && (covered >> lane & 1) != 0)
                draw_whole(b, lane, *at, name, tile.depth + first, tile.id + first, drawn);
            else
                draw_rows<kUsual>(tile.rule, b, lane, *at, name, tile.depth + first,
                                  tile.id + first, drawn);
        }
    }
    if constexpr (kUsual) keep_farthest(tile, w, block, b, covered);
}

// Blocks are few: those of all triangles side by side, one after the other.
template <bool kUsual>
HWY_INLINE void draw_small(const TilePlanes& tile, const Walks& w, int i, std::uint32_t live,
                           I32x8& drawn) {
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
        const std::uint32_t show = seen<kUsual>(tile, lanes, blocks, live);
        if (show != 0) draw_flat<kUsual, false>(tile, lanes, blocks, show, w.id + i, drawn);
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
    lanes.x0 = w.x0[i];
    lanes.y0 = w.y0[i];
    lanes.x1 = w.x1[i];
    lanes.y1 = w.y1[i];
    // Those that show first, then these packed: most lanes of a register have work then.
    constexpr int kBlocks = kTileSize / BlockWalk::kSide;
    std::int32_t show_x[kBlocks * kBlocks + kLanesX8], show_y[kBlocks * kBlocks + kLanesX8];
    int shown = 0;
    const int x1 = (w.x1[i] + 7) / 8, y1 = (w.y1[i] + 7) / 8;
    for (int y = w.y0[i] / 8; y < y1; ++y)
        for (int x = w.x0[i] / 8; x < x1; x += kLanesX8) {
            const int blocks = x1 - x < kLanesX8 ? x1 - x : kLanesX8;
            std::uint32_t show = seen<kUsual>(
                tile, lanes, at_blocks(tile, lanes, iota<I32x8>(x), y), (1U << blocks) - 1);
            for (; show != 0; show &= show - 1) {
                show_x[shown] = x + __builtin_ctz(show);
                show_y[shown++] = y;
            }
        }
    for (int k = 0; k < kLanesX8; ++k) // what the last register reads beyond
        show_x[shown + k] = show_y[shown + k] = 0;
    for (int k = 0; k < shown; k += kLanesX8) {
        const std::uint32_t live =
            shown - k < kLanesX8 ? (1U << (shown - k)) - 1 : (1U << kLanesX8) - 1;
        const AtBlocks blocks =
            at_blocks(tile, lanes, load<I32x8>(show_x + k), load<I32x8>(show_y + k));
        draw_flat<kUsual, true>(tile, lanes, blocks, live, &id, drawn);
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

template <bool kUsual>
HWY_INLINE bool draw_all(const TilePlanes& tile, const SampleExtent& extent,
                         const TriangleList& list) {
    constexpr std::uint32_t kRegister = (1U << kLanesX8) - 1;
    I32x8 drawn = 0;
    Walks w;
    const auto all = static_cast<int>(list.which.size());
    for (int begin = 0; begin < all; begin += Walks::kRoom) {
        const int count = all - begin < Walks::kRoom ? all - begin : Walks::kRoom;
        load_corners(list, begin, count, w);
        set_up(tile, extent, list.vertices.data(), count, w);
        const std::uint32_t small = w.live & w.flat & w.small;
        for (int i = 0; i < Walks::kRoom; i += kLanesX8)
            draw_small<kUsual>(tile, w, i, small >> i & kRegister, drawn);
        for (std::uint32_t rest = w.live & ~small; rest != 0; rest &= rest - 1) {
            const int i = __builtin_ctz(rest);
            const std::uint32_t id = w.id[i];
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

bool draw_usual(const TilePlanes& tile, const SampleExtent& extent, const TriangleList& list) {
    return draw_all<true>(tile, extent, list);
}
bool draw_by_rule(const TilePlanes& tile, const SampleExtent& extent, const TriangleList& list) {
    return draw_all<false>(tile, extent, list);
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
SIMD_REGISTER(draw_by_rule);
SIMD_REGISTER(flat_alone);

bool draw_triangles(const TilePlanes& tile, const TriangleList& triangles) {
    const SampleExtent extent = extent_of(tile.pattern);
    return tile.rule.usual() ? SIMD_CALL(draw_usual)(tile, extent, triangles)
                             : SIMD_CALL(draw_by_rule)(tile, extent, triangles);
}

bool near_to_flat(const SnappedTriangle& triangle) {
    return SIMD_CALL(flat_alone)(triangle.corner.data());
}

} // namespace scanout::raster
#endif
