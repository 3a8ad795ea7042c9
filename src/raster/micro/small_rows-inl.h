// Small triangles of any size, a register of them set up at a time and rasterised one by one, in
// rows as wide as a block, with float or double depth (raster/coverage/coverage.h). Included once
// for every SIMD target.
#if defined(SCANOUT_RASTER_MICRO_SMALL_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_MICRO_SMALL_ROWS_INL_H
#undef SCANOUT_RASTER_MICRO_SMALL_ROWS_INL_H
#else
#define SCANOUT_RASTER_MICRO_SMALL_ROWS_INL_H
#endif

#include "raster/coverage/blocks-inl.h"
#include "raster/micro/small_setup-inl.h"

SIMD_BEGIN(scanout::raster)

using SmallLanesX8 = SmallLanes<F32x8::Tag>;
using SmallEdgesX8 = SmallEdges<F32x8::Tag>;
using SmallSetupX8 = SmallSetup<F32x8::Tag>;

constexpr std::size_t kMaxSamples = std::size(detail::kSixteen); // of a pixel
constexpr int kAcross = PixelBlock::kSide / kLanesX8; // registers, of eight pixels of a row

// The edge functions at the samples of the pixels (column, row), from the first block's corner.
SIMD_INLINE void set_up_row_edges(const TilePlanes& tile, const SmallEdgesX8& edges, I32x8 column,
                                  I32x8 row, std::int32_t (&first)[kMaxSamples][3][kLanesX8]) {
    I32x8 corner[3];
    edges_at_pixel(edges, column, row, corner);
    for (std::size_t n = 0; n < tile.pattern.size(); ++n) {
        I32x8 at[3];
        edges_at(edges, corner, tile.pattern.data()[n], at);
        SIMD_FOR (int k = 0; k < 3; ++k)
            store(at[k], first[n][k]);
    }
}

// Triangles with double depth, one a lane.
struct DoubleDepthRows {
    std::int32_t across[kLanesX8], down[kLanesX8], pixel_offset[kLanesX8]; // pixels
    std::int32_t per_x[3][kLanesX8], per_y[3][kLanesX8], bias[3][kLanesX8];
    double depth_factor[3][kLanesX8];
    std::int32_t first[kMaxSamples][3][kLanesX8]; // the edges at the first pixel's samples
};

// Draws column by column of eight pixels, row by row in each. Computes depth from the edge
// functions at every sample, in double (raster/coverage/coverage.h).
template <DepthWrite kWrite>
SIMD_INLINE void draw_double_depth_rows(const TilePlanes& tile, const DoubleDepthRows& s, int lane,
                                        std::uint32_t primitive, I32x8& drawn) {
    F64x8 depth_factor[3], down_wide[3];
    I32x8 down[3];
    SIMD_FOR (int k = 0; k < 3; ++k) {
        depth_factor[k] = s.depth_factor[k][lane];
        down[k] = s.per_y[k][lane];
        down_wide[k] = static_cast<double>(s.per_y[k][lane]);
    }
    const int across = s.across[lane], rows = s.down[lane];
    I32x8 written = 0;
    std::ptrdiff_t first = s.pixel_offset[lane]; // pixel of the plane
    for (std::size_t n = 0; n < tile.pattern.size();
         ++n, first += std::ptrdiff_t{kTileSize} * kTileSize)
        for (int column = 0; column < across; column += kLanesX8) {
            const I32x8 number = iota<I32x8>(column);
            I32x8 edge[3];
            F64x8 exact[3]; // the same without the bias
            SIMD_FOR (int k = 0; k < 3; ++k) {
                edge[k] = I32x8(s.first[n][k][lane]) + I32x8(s.per_x[k][lane]) * number;
                exact[k] = to_f64(edge[k] - I32x8(s.bias[k][lane]));
            }
            const I32x8 outside = -(1 << 30); // stays negative: the steps add less than 2^29
            edge[0] = select(number < I32x8(across), edge[0], outside);
            float* depth = tile.depth + first + column;
            std::uint32_t* id = id_after<kWrite>(tile.id, first + column);
            for (int row = 0; row < rows;
                 ++row, depth += kTileSize, id = id_after<kWrite>(id, kTileSize)) {
                const MaskX8 inside = (edge[0] | edge[1] | edge[2]) > I32x8(-1);
                write_samples<kWrite>({}, inside, to_f32(depth_of(exact, depth_factor)), primitive,
                                      depth, id, written);
                SIMD_FOR (int k = 0; k < 3; ++k) {
                    edge[k] = edge[k] + down[k];
                    exact[k] = exact[k] + down_wide[k];
                }
            }
        }
    drawn = drawn | written;
}

// live: of the lanes.
template <DepthWrite kWrite>
HWY_NOINLINE void draw_double_depth(const TilePlanes& tile, const SmallSetupX8& s,
                                    std::uint32_t live, I32x8& drawn) {
    const SmallLanesX8& lanes = s.lanes;
    DoubleDepthRows rows;
    store(lanes.x1 - lanes.x0, rows.across);
    store(lanes.y1 - lanes.y0, rows.down);
    store(lanes.y0 * I32x8(kTileSize) + lanes.x0, rows.pixel_offset);
    SIMD_FOR (int k = 0; k < 3; ++k) {
        store(shift_left<kSubpixelBits>(s.edges.a[k]), rows.per_x[k]);
        store(shift_left<kSubpixelBits>(s.edges.b[k]), rows.per_y[k]);
        store(s.edges.bias[k], rows.bias[k]);
        store(s.plane.depth_factor[k], rows.depth_factor[k]);
    }
    set_up_row_edges(tile, s.edges, lanes.x0 - lanes.left, lanes.y0 - lanes.top, rows.first);
    for (; live != 0; live &= live - 1) {
        const int lane = __builtin_ctz(live);
        draw_double_depth_rows<kWrite>(tile, rows, lane, lanes.id[lane], drawn);
    }
}

// Blocks that a small triangle may touch, each way.
constexpr int kMaxBlocks = kSmallSide / PixelBlock::kSide + 1;

// Rows of triangles with float depth, one triangle a lane. A row is as wide as a block and starts
// at a column of the triangle, so most triangles take one register a row wherever they lie in their
// blocks. Depth still starts from the corner of the block that a pixel lies in.
struct SmallRows {
    std::int32_t across[kLanesX8], down[kLanesX8]; // pixels
    std::int32_t column[kLanesX8], row[kLanesX8];  // of the first pixel, in its block
    float first_row[kLanesX8];                     // the same row
    float base[kMaxBlocks][2][kLanesX8];           // at the corners of blocks, downwards and
    float rest[kMaxBlocks][2][kLanesX8];           // across (FloatDepthBlocks)
    std::int32_t first[kMaxSamples][3][kLanesX8];  // the edges at the first pixel's samples
};

// Computes the depths at the blocks' corners. Returns the lanes that hi_z does not occlude.
SIMD_INLINE std::uint32_t set_up_block_depths(const TilePlanes& tile, const SmallSetupX8& s,
                                              I32x8 x0, I32x8 x1, std::uint32_t live,
                                              SmallRows& out) {
    constexpr int kSide = PixelBlock::kSide, kBlocks = kTileSize / kSide;
    const SmallLanesX8& lanes = s.lanes;
    const I32x8 left = x0 & I32x8(-kSide), right = left + I32x8(kSide);
    I32x8 edge[3], step[3];
    SIMD_FOR (int k = 0; k < 3; ++k) {
        step[k] = shift_left<kSubpixelBits>(s.edges.a[k]);
        edge[k] = s.edges.c[k] + step[k] * (left - lanes.left);
    }
    std::uint32_t visible = tile.hi_z == nullptr ? live : 0;
    I32x8 top = lanes.top;
    for (int down = 0; down < kMaxBlocks; ++down) {
        const std::uint32_t here = live & bits(top < lanes.y1);
        if (here == 0) break;
        const std::uint32_t in_column[] = {here, here & bits(right < x1)};
        SIMD_FOR (int across = 0; across < 2; ++across) {
            I32x8 corner[3];
            SIMD_FOR (int k = 0; k < 3; ++k)
                corner[k] = across == 0 ? edge[k] : edge[k] + step[k] * I32x8(kSide);
            const F64x8 depth = depth_of(corner, s.plane.depth_factor);
            const F32x8 base = to_f32(depth);
            store(base, out.base[down][across]);
            store(to_f32(depth - to_f64(base)), out.rest[down][across]);
            if (tile.hi_z == nullptr) continue;
            const I32x8 block = top + shift_right<3>(across == 0 ? left : right); // eight a row
            const I32x8 safe = minimum(block, kBlocks * kBlocks - 1); // of lanes past their end
            visible |= in_column[across] & bits(nearest_in(depth, s.plane.per_x, s.plane.per_y) >=
                                                gather(tile.hi_z, safe));
        }
        top = top + I32x8(kSide);
        SIMD_FOR (int k = 0; k < 3; ++k)
            edge[k] = edge[k] + shift_left<kSubpixelBits>(s.edges.b[k]) * I32x8(kSide);
    }
    return visible;
}

// Draws row by row, one sample after the other: from the second sample on, the branch predictor
// knows the number of rows.
template <DepthWrite kWrite>
SIMD_INLINE void draw_triangle_rows(const TilePlanes& tile, const FloatDepthBlocks& b,
                                    const SmallRows& s, int lane, std::uint32_t primitive,
                                    I32x8& drawn) {
    constexpr int kSide = PixelBlock::kSide;
    const F32x8 per_pixel_x = b.per_pixel_x[lane], per_pixel_y = b.per_pixel_y[lane];
    I32x8 from_first[3][kAcross], down[3];
    F32x8 column[kAcross];
    MaskX8 right[kAcross];
    SIMD_FOR (int k = 0; k < 3; ++k)
        down[k] = b.per_y[k][lane];
    SIMD_FOR (int r = 0; r < kAcross; ++r) {
        const I32x8 number = iota<I32x8>(r * kLanesX8), in_block = number + s.column[lane];
        right[r] = in_block >= I32x8(kSide);
        column[r] = to_f32(in_block & I32x8(kSide - 1));
        SIMD_FOR (int k = 0; k < 3; ++k)
            from_first[k][r] = I32x8(b.per_x[k][lane]) * number;
        const I32x8 outside = -(1 << 30); // stays negative: the steps add less than 2^29
        from_first[0][r] = select(number < I32x8(s.across[lane]), from_first[0][r], outside);
    }
    I32x8 written = 0;
    std::ptrdiff_t first = b.pixel_offset[lane]; // pixel of the plane
    for (std::size_t n = 0; n < tile.pattern.size();
         ++n, first += std::ptrdiff_t{kTileSize} * kTileSize) {
        const SampleOffset at = tile.pattern.data()[n];
        const F32x8 sample_x = static_cast<float>(at.x) / kSubpixel;
        I32x8 edge[3][kAcross];
        F32x8 across[kAcross];
        SIMD_FOR (int r = 0; r < kAcross; ++r) {
            across[r] = (column[r] + sample_x) * per_pixel_x;
            SIMD_FOR (int k = 0; k < 3; ++k)
                edge[k][r] = I32x8(s.first[n][k][lane]) + from_first[k][r];
        }
        float* depth = tile.depth + first;
        std::uint32_t* id = id_after<kWrite>(tile.id, first);
        int row = s.row[lane];
        const int end = row + s.down[lane];
        F32x8 y = F32x8(s.first_row[lane]) + F32x8(static_cast<float>(at.y) / kSubpixel);
        for (int block = 0; row < end; ++block) {
            F32x8 base[kAcross], rest[kAcross];
            SIMD_FOR (int r = 0; r < kAcross; ++r) {
                base[r] =
                    select(right[r], F32x8(s.base[block][1][lane]), F32x8(s.base[block][0][lane]));
                rest[r] =
                    select(right[r], F32x8(s.rest[block][1][lane]), F32x8(s.rest[block][0][lane]));
            }
            const int last = (block + 1) * kSide < end ? (block + 1) * kSide : end;
            for (; row < last; ++row, depth += kTileSize, id = id_after<kWrite>(id, kTileSize)) {
                const F32x8 down_here = y * per_pixel_y;
                SIMD_FOR (int r = 0; r < kAcross; ++r) {
                    const MaskX8 inside = (edge[0][r] | edge[1][r] | edge[2][r]) > I32x8(-1);
                    write_samples<kWrite>({}, inside, base[r] + (rest[r] + (across[r] + down_here)),
                                          primitive, depth + r * kLanesX8,
                                          id_after<kWrite>(id, r * kLanesX8), written);
                    SIMD_FOR (int k = 0; k < 3; ++k)
                        edge[k][r] = edge[k][r] + down[k];
                }
                y = y + F32x8(1.0F);
            }
            y = y - F32x8(kSide);
        }
    }
    drawn = drawn | written;
}

template <DepthWrite kWrite>
SIMD_INLINE void draw_columns(const TilePlanes& tile, const SmallSetupX8& s, I32x8 x0,
                              std::uint32_t live, FloatDepthBlocks& b, I32x8& drawn) {
    constexpr int kSide = PixelBlock::kSide;
    const SmallLanesX8& lanes = s.lanes;
    const I32x8 x1 = minimum(lanes.x1, x0 + I32x8(kSide));
    SmallRows rows;
    std::uint32_t visible = set_up_block_depths(tile, s, x0, x1, live, rows);
    if (visible == 0) return;
    store(x1 - x0, rows.across);
    store(lanes.y1 - lanes.y0, rows.down);
    store(x0 & I32x8(kSide - 1), rows.column);
    store(lanes.y0 - lanes.top, rows.row);
    store(to_f32(lanes.y0 - lanes.top), rows.first_row);
    store(lanes.y0 * I32x8(kTileSize) + x0, b.pixel_offset);
    SIMD_FOR (int k = 0; k < 3; ++k) {
        store(shift_left<kSubpixelBits>(s.edges.a[k]), b.per_x[k]);
        store(shift_left<kSubpixelBits>(s.edges.b[k]), b.per_y[k]);
    }
    set_up_row_edges(tile, s.edges, x0 - lanes.left, lanes.y0 - lanes.top, rows.first);
    for (; visible != 0; visible &= visible - 1) {
        const int lane = __builtin_ctz(visible);
        draw_triangle_rows<kWrite>(tile, b, rows, lane, lanes.id[lane], drawn);
    }
}

template <DepthWrite kWrite>
SIMD_INLINE void draw_float_depth(const TilePlanes& tile, const SmallSetupX8& s, std::uint32_t live,
                                  I32x8& drawn) {
    FloatDepthBlocks b;
    store(I32x8(0), b.begin);
    store(to_f32(s.plane.per_x), b.per_pixel_x);
    store(to_f32(s.plane.per_y), b.per_pixel_y);
    for (I32x8 x = s.lanes.x0; live != 0; live &= bits(x < s.lanes.x1)) {
        draw_columns<kWrite>(tile, s, x, live, b, drawn);
        x = x + I32x8(PixelBlock::kSide);
    }
}

SIMD_END

#endif
