// Blocks of 8 x 8 pixels of triangles with float depth (raster/coverage/coverage.h), several side
// by side. Included once for every SIMD target.
#if defined(SCANOUT_RASTER_COVERAGE_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_COVERAGE_BLOCKS_INL_H
#undef SCANOUT_RASTER_COVERAGE_BLOCKS_INL_H
#else
#define SCANOUT_RASTER_COVERAGE_BLOCKS_INL_H
#endif

#include "raster/coverage/reject_blocks-inl.h"
#include "raster/coverage/triangle_setup-inl.h"

SIMD_BEGIN(scanout::raster)

// TriangleSetup in registers: of several triangles, or of one in all lanes.
struct SetupLanes {
    F64x8 a[3], b[3], c[3], bias[3], lowest[3], highest[3], depth_factor[3], per_x, per_y;
    I32x8 x0, y0, x1, y1;
};
template <class Read>
SIMD_INLINE SetupLanes setup_lanes(const TriangleSetup& w, const Read& read) {
    SetupLanes lanes;
    SIMD_FOR (int k = 0; k < 3; ++k) {
        lanes.a[k] = read(w.a[k]);
        lanes.b[k] = read(w.b[k]);
        lanes.c[k] = read(w.c[k]);
        lanes.bias[k] = read(w.bias[k]);
        lanes.lowest[k] = read(w.lowest[k]);
        lanes.highest[k] = read(w.highest[k]);
        lanes.depth_factor[k] = read(w.depth_factor[k]);
    }
    lanes.per_x = read(w.per_x);
    lanes.per_y = read(w.per_y);
    return lanes;
}

// Blocks of triangles with float depth, one a lane, at one sample of the pattern.
struct FloatDepthBlocks {
    // At the first pixel of row `begin`, a number with the sign of E + bias, and its steps a pixel:
    // floor( (E + bias) / 256), or 0 where the edge holds for the whole block; or E + bias itself.
    std::int32_t first[3][kLanesX8], per_x[3][kLanesX8], per_y[3][kLanesX8];
    std::int32_t begin[kLanesX8], end[kLanesX8]; // rows
    std::int32_t pixel_offset[kLanesX8];         // of the first pixel, in a plane of the tile
    // Depth at the block's corner: base + rest; its steps a pixel.
    float base[kLanesX8], rest[kLanesX8], per_pixel_x[kLanesX8], per_pixel_y[kLanesX8];
};

// Draws row by row, the rows inside of the triangle's box.
template <DepthWrite kWrite>
SIMD_INLINE void draw_rows(const DepthRule& rule, const FloatDepthBlocks& b, int lane,
                           SampleOffset at, std::uint32_t primitive, float* depth,
                           std::uint32_t* id, I32& drawn) {
    const F32 sample_x = static_cast<float>(at.x) / kSubpixel;
    const F32 sample_y = static_cast<float>(at.y) / kSubpixel;
    const F32 base = b.base[lane], rest = b.rest[lane];
    const F32 per_pixel_x = b.per_pixel_x[lane], per_pixel_y = b.per_pixel_y[lane];
    // Registers of two rows start at an even row: they stay in the block. The row before `begin`
    // holds no covered sample, and some edge rejects it: an edge is 0 only if it holds for the
    // whole block. Rows from `end` on lie outside the picture, which no edge rejects.
    const int begin = b.begin[lane] & -kRows, end = b.end[lane];
    I32 edge[3][kRegisters], down[3];
    F32 across[kRegisters];
    SIMD_FOR (int k = 0; k < 3; ++k) {
        const I32 per_y = b.per_y[k][lane];
        const I32 first = I32(b.first[k][lane]) + per_y * (rows() - I32(b.begin[lane] - begin));
        SIMD_FOR (int r = 0; r < kRegisters; ++r)
            edge[k][r] = first + I32(b.per_x[k][lane]) * columns(r);
        down[k] = per_y * I32(kRows);
    }
    SIMD_FOR (int r = 0; r < kRegisters; ++r)
        across[r] = (to_f32(columns(r)) + sample_x) * per_pixel_x;
    depth += begin * kTileSize;
    id = id_after<kWrite>(id, begin * kTileSize);
    F32 row = to_f32(rows() + I32(begin)) + sample_y; // a whole number of 1/256: exact
    for (int y = begin; y < end; y += kRows) {
        const F32 down_here = row * per_pixel_y;
        SIMD_FOR (int r = 0; r < kRegisters; ++r) {
            auto inside = (edge[0][r] | edge[1][r] | edge[2][r]) >= I32(0);
            if constexpr (kRows > 1) inside = inside & (rows() < I32(end - y));
            const F32 z = base + (rest + (across[r] + down_here));
            write_samples<kWrite>(rule, inside, z, primitive, depth + r * kLanes,
                                  id_after<kWrite>(id, r * kLanes), drawn);
            SIMD_FOR (int k = 0; k < 3; ++k)
                edge[k][r] = edge[k][r] + down[k];
        }
        row = row + F32(kRows);
        depth += kRows * kTileSize;
        id = id_after<kWrite>(id, kRows * kTileSize);
    }
}

// floor((E + bias) / 256), which saturates at 2^29 (PixelBlock).
SIMD_INLINE F64x8 floor_in_pixels(F64x8 e, F64x8 bias) {
    const F64x8 most = 0x1p29;
    const F64x8 pixels = (e + bias) * F64x8(1.0 / kSubpixel);
    const F64x8 near = minimum(maximum(pixels, -most), most);
    const F64x8 cut = to_f64(to_i32(near)); // towards zero
    return cut - select(cut > near, F64x8(1.0), F64x8(0.0));
}

// The edge functions at one sample of the pattern.
SIMD_INLINE void set_up_rows(const SetupLanes& w, const F64x8 (&corner)[3],
                             const Double<F32x8::Tag>::DoubleMask (&whole)[3], SampleOffset at,
                             I32x8 begin, FloatDepthBlocks& out) {
    const F64x8 zero = 0.0, x = double(at.x), y = double(at.y);
    SIMD_FOR (int k = 0; k < 3; ++k) {
        const F64x8 e = corner[k] + (w.a[k] * x + w.b[k] * y);
        const F64x8 floor = floor_in_pixels(e, w.bias[k]);
        const I32x8 per_y = to_i32(select(whole[k], zero, w.b[k]));
        store(to_i32(select(whole[k], zero, floor)) + per_y * begin, out.first[k]);
        store(to_i32(select(whole[k], zero, w.a[k])), out.per_x[k]);
        store(per_y, out.per_y[k]);
    }
}

// The same for draw_large, also for edges that hold for the whole block.
SIMD_INLINE void set_up_firsts(const SetupLanes& w, const F64x8 (&corner)[3], SampleOffset at,
                               std::int32_t (&first)[3][kLanesX8]) {
    const F64x8 x = double(at.x), y = double(at.y);
    SIMD_FOR (int k = 0; k < 3; ++k)
        store(to_i32(floor_in_pixels(corner[k] + (w.a[k] * x + w.b[k] * y), w.bias[k])), first[k]);
}

// Blocks (x, y) of the tile, one a lane, and the edge functions and depth at their corners.
struct AtBlocks {
    I32x8 left, top; // pixels in the tile
    F64x8 edge[3], depth;
};
SIMD_INLINE AtBlocks at_blocks(const TilePlanes& tile, const SetupLanes& w, I32x8 x, I32x8 y) {
    constexpr int kSideBits = 3;
    static_assert(PixelBlock::kSide == 1 << kSideBits);
    AtBlocks at;
    at.left = shift_left<kSideBits>(x);
    at.top = shift_left<kSideBits>(y);
    const F64x8 corner_x = to_f64(shift_left<kSubpixelBits>(at.left + I32x8(tile.area.x0)));
    const F64x8 corner_y = to_f64(shift_left<kSubpixelBits>(at.top + I32x8(tile.area.y0)));
    SIMD_FOR (int k = 0; k < 3; ++k)
        at.edge[k] = (w.a[k] * corner_x + w.b[k] * corner_y) + w.c[k];
    at.depth = depth_of(at.edge, w.depth_factor);
    return at;
}

// An upper bound of a triangle's depth in blocks; depth: at their corners. The margin of 2^-20 is
// far more than all rounding before.
SIMD_INLINE F32x8 nearest_in(F64x8 depth, F64x8 per_x, F64x8 per_y) {
    const F64x8 side = double{PixelBlock::kSide}, zero = 0.0;
    const F64x8 reach = (maximum(per_x, zero) + maximum(per_y, zero)) * side;
    return to_f32((depth + reach) * F64x8(1 + 0x1p-20));
}

// The live lanes whose block the triangle may touch and hi_z does not reject.
template <bool kDefault>
SIMD_INLINE std::uint32_t visible_lanes(const TilePlanes& tile, const SetupLanes& w,
                                        const AtBlocks& at, std::uint32_t live) {
    SIMD_FOR (int k = 0; k < 3; ++k)
        live &= bits(at.edge[k] + w.highest[k] >= F64x8(0.0));
    if (!kDefault || live == 0 || tile.hi_z == nullptr) return live;
    // Lanes past their triangle's end may also be past the tile's end.
    const I32x8 block = minimum(at.top + shift_right<3>(at.left), BlockList::kBlocks - 1);
    return live & bits(nearest_in(at.depth, w.per_x, w.per_y) >= gather(tile.hi_z, block));
}

// Draws the blocks of the `live` lanes; each lane has a triangle of its own.
template <DepthWrite kWrite>
SIMD_INLINE void draw_float_depth_blocks(const TilePlanes& tile, const SetupLanes& w,
                                         const AtBlocks& block, std::uint32_t live,
                                         const std::uint32_t* id, I32& drawn) {
    const F64x8 zero = 0.0;
    Double<F32x8::Tag>::DoubleMask whole[3];
    SIMD_FOR (int k = 0; k < 3; ++k)
        whole[k] = block.edge[k] + w.lowest[k] >= zero;
    FloatDepthBlocks b;
    const F32x8 base = to_f32(block.depth);
    store(base, b.base);
    store(to_f32(block.depth - to_f64(base)), b.rest);
    store(to_f32(w.per_x), b.per_pixel_x);
    store(to_f32(w.per_y), b.per_pixel_y);
    const I32x8 begin = maximum(w.y0 - block.top, 0);
    store(begin, b.begin);
    store(minimum(w.y1 - block.top, PixelBlock::kSide), b.end);
    store(block.top * I32x8(kTileSize) + block.left, b.pixel_offset);
    std::ptrdiff_t plane = 0;
    for (const SampleOffset* at = tile.pattern.data();
         at != tile.pattern.data() + tile.pattern.size();
         ++at, plane += std::ptrdiff_t{kTileSize} * kTileSize) {
        set_up_rows(w, block.edge, whole, *at, begin, b);
        float* const depth = tile.depth + plane;
        std::uint32_t* const ids = id_after<kWrite>(tile.id, plane);
        for (std::uint32_t rest = live; rest != 0; rest &= rest - 1) {
            const int lane = __builtin_ctz(rest);
            const std::int32_t first = b.pixel_offset[lane];
            draw_rows<kWrite>(tile.rule, b, lane, *at, id[lane], depth + first,
                              id_after<kWrite>(ids, first), drawn);
        }
    }
}

SIMD_END

#endif
