// Parts of small triangles of any size, a register of them set up at a time and drawn one by one,
// as strips as wide as a block: of flat ones depth is in float, of steep ones in double. Included
// once for every SIMD target.
#if defined(SCANOUT_RASTER_STRIPS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_STRIPS_INL_H
#undef SCANOUT_RASTER_STRIPS_INL_H
#else
#define SCANOUT_RASTER_STRIPS_INL_H
#endif

#include "raster/blocks-inl.h"
#include "raster/parts-inl.h"

SIMD_BEGIN(scanout::raster)

using PartLanesX8 = PartLanes<F32x8::Tag>;
using PartEdgesX8 = PartEdges<F32x8::Tag>;
using SetUpPartsX8 = SetUpParts<F32x8::Tag>;

constexpr std::size_t kMostSamples = std::size(detail::kSixteen); // of a pixel
constexpr int kAcross = BlockWalk::kSide / kLanesX8;              // registers, of a row of a strip

// The edges of parts at the samples of their pixels (column, row), from the first block's corner.
SIMD_INLINE void set_up_strip_edges(const TilePlanes& tile, const PartEdgesX8& edges, I32x8 column,
                                    I32x8 row, std::int32_t (&first)[kMostSamples][3][kLanesX8]) {
    I32x8 corner[3];
    edges_at_pixel(edges, column, row, corner);
    for (std::size_t n = 0; n < tile.pattern.size(); ++n) {
        I32x8 at[3];
        edges_at(edges, corner, tile.pattern.data()[n], at);
        SIMD_FOR (int k = 0; k < 3; ++k)
            store(at[k], first[n][k]);
    }
}

// Steep parts, one a lane.
struct SteepStrips {
    std::int32_t across[kLanesX8], down[kLanesX8], place[kLanesX8]; // pixels
    std::int32_t per_x[3][kLanesX8], per_y[3][kLanesX8], bias[3][kLanesX8];
    double share[3][kLanesX8];
    std::int32_t first[kMostSamples][3][kLanesX8]; // the edges at the first pixel's samples
};

// Row by row, a strip after the other. Depth by the edge functions at every sample, in double
// (coverage.h).
template <Shows kShows>
SIMD_INLINE void draw_steep_strips(const TilePlanes& tile, const SteepStrips& s, int lane,
                                   std::uint32_t name, I32x8& drawn) {
    F64x8 share[3], down_wide[3];
    I32x8 down[3];
    SIMD_FOR (int k = 0; k < 3; ++k) {
        share[k] = s.share[k][lane];
        down[k] = s.per_y[k][lane];
        down_wide[k] = static_cast<double>(s.per_y[k][lane]);
    }
    const int across = s.across[lane], rows = s.down[lane];
    I32x8 shows = 0;
    std::ptrdiff_t first = s.place[lane]; // pixel of the plane
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
            const I32x8 outside = -(1 << 30); // and stays so: what is added is less than 2^29
            edge[0] = select(number < I32x8(across), edge[0], outside);
            float* depth = tile.depth + first + column;
            std::uint32_t* id = id_after<kShows>(tile.id, first + column);
            for (int row = 0; row < rows;
                 ++row, depth += kTileSize, id = id_after<kShows>(id, kTileSize)) {
                const MaskX8 inside = (edge[0] | edge[1] | edge[2]) > I32x8(-1);
                show_samples<kShows>({}, inside, to_f32(depth_of(exact, share)), name, depth, id,
                                     shows);
                SIMD_FOR (int k = 0; k < 3; ++k) {
                    edge[k] = edge[k] + down[k];
                    exact[k] = exact[k] + down_wide[k];
                }
            }
        }
    drawn = drawn | shows;
}

// live: of the lanes.
template <Shows kShows>
HWY_NOINLINE void draw_steep_parts(const TilePlanes& tile, const SetUpPartsX8& s,
                                   std::uint32_t live, I32x8& drawn) {
    const PartLanesX8& part = s.part;
    SteepStrips strips;
    store(part.x1 - part.x0, strips.across);
    store(part.y1 - part.y0, strips.down);
    store(part.y0 * I32x8(kTileSize) + part.x0, strips.place);
    SIMD_FOR (int k = 0; k < 3; ++k) {
        store(shift_left<kSubpixelBits>(s.edges.a[k]), strips.per_x[k]);
        store(shift_left<kSubpixelBits>(s.edges.b[k]), strips.per_y[k]);
        store(s.edges.bias[k], strips.bias[k]);
        store(s.plane.share[k], strips.share[k]);
    }
    set_up_strip_edges(tile, s.edges, part.x0 - part.left, part.y0 - part.top, strips.first);
    for (; live != 0; live &= live - 1) {
        const int lane = __builtin_ctz(live);
        draw_steep_strips<kShows>(tile, strips, lane, part.name[lane], drawn);
    }
}

// Each way at most as many blocks hold a part.
constexpr int kMostBlocks = kSmallSide / BlockWalk::kSide + 1;

// Strips of flat parts, one a lane: as wide as a block, from a column of the part on. So most parts
// are one register a row, wherever in their blocks they lie. Depth still starts from the corner of
// the block that a pixel lies in.
struct Strips {
    std::int32_t across[kLanesX8], down[kLanesX8]; // pixels
    std::int32_t column[kLanesX8], row[kLanesX8];  // of the first pixel, in its block
    float first_row[kLanesX8];                     // the same row
    float base[kMostBlocks][2][kLanesX8];          // at the corners of blocks, downwards and
    float rest[kMostBlocks][2][kLanesX8];          // across (Blocks)
    std::int32_t first[kMostSamples][3][kLanesX8]; // the edges at the first pixel's samples
};

// The blocks' depths. Returns the lanes of which something may be seen.
SIMD_INLINE std::uint32_t set_up_depth(const TilePlanes& tile, const SetUpPartsX8& s, I32x8 x0,
                                       I32x8 x1, std::uint32_t live, Strips& out) {
    constexpr int kSide = BlockWalk::kSide, kBlocks = kTileSize / kSide;
    const PartLanesX8& part = s.part;
    const I32x8 left = x0 & I32x8(-kSide), right = left + I32x8(kSide);
    I32x8 edge[3], step[3];
    SIMD_FOR (int k = 0; k < 3; ++k) {
        step[k] = shift_left<kSubpixelBits>(s.edges.a[k]);
        edge[k] = s.edges.c[k] + step[k] * (left - part.left);
    }
    std::uint32_t seen = tile.farthest == nullptr ? live : 0;
    I32x8 top = part.top;
    for (int down = 0; down < kMostBlocks; ++down) {
        const std::uint32_t here = live & bits(top < part.y1);
        if (here == 0) break;
        const std::uint32_t in_column[] = {here, here & bits(right < x1)};
        SIMD_FOR (int across = 0; across < 2; ++across) {
            I32x8 corner[3];
            SIMD_FOR (int k = 0; k < 3; ++k)
                corner[k] = across == 0 ? edge[k] : edge[k] + step[k] * I32x8(kSide);
            const F64x8 depth = depth_of(corner, s.plane.share);
            const F32x8 base = to_f32(depth);
            store(base, out.base[down][across]);
            store(to_f32(depth - to_f64(base)), out.rest[down][across]);
            if (tile.farthest == nullptr) continue;
            const I32x8 block = top + shift_right<3>(across == 0 ? left : right); // eight a row
            const I32x8 safe = minimum(block, kBlocks * kBlocks - 1); // of lanes past their end
            seen |= in_column[across] & bits(nearest_in(depth, s.plane.per_x, s.plane.per_y) >=
                                             gather(tile.farthest, safe));
        }
        top = top + I32x8(kSide);
        SIMD_FOR (int k = 0; k < 3; ++k)
            edge[k] = edge[k] + shift_left<kSubpixelBits>(s.edges.b[k]) * I32x8(kSide);
    }
    return seen;
}

// A pixel's samples: the only one, known ahead of all strips, or several.
struct OneSample {
    SampleOffset only;
    static constexpr std::size_t size() { return 1; }
    SIMD_INLINE SampleOffset operator[](std::size_t) const { return only; }
};
struct ManySamples {
    const std::span<const SampleOffset> all;
    SIMD_INLINE std::size_t size() const { return all.size(); }
    SIMD_INLINE SampleOffset operator[](std::size_t n) const { return all.data()[n]; }
};

// Row by row, at one sample after the other: how many rows there are is foretold from the second
// sample on.
template <Shows kShows, class Samples>
SIMD_INLINE void draw_strip(const TilePlanes& tile, const Samples& samples, const Blocks& b,
                            const Strips& s, int lane, std::uint32_t name, I32x8& drawn) {
    constexpr int kSide = BlockWalk::kSide;
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
        const I32x8 outside = -(1 << 30); // and stays so: what is added is less than 2^29
        from_first[0][r] = select(number < I32x8(s.across[lane]), from_first[0][r], outside);
    }
    I32x8 shows = 0;
    std::ptrdiff_t first = b.place[lane]; // pixel of the plane
    for (std::size_t n = 0; n < samples.size();
         ++n, first += std::ptrdiff_t{kTileSize} * kTileSize) {
        const SampleOffset at = samples[n];
        const F32x8 sample_x = static_cast<float>(at.x) / kSubpixel;
        I32x8 edge[3][kAcross];
        F32x8 across[kAcross];
        SIMD_FOR (int r = 0; r < kAcross; ++r) {
            across[r] = (column[r] + sample_x) * per_pixel_x;
            SIMD_FOR (int k = 0; k < 3; ++k)
                edge[k][r] = I32x8(s.first[n][k][lane]) + from_first[k][r];
        }
        float* depth = tile.depth + first;
        std::uint32_t* id = id_after<kShows>(tile.id, first);
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
            for (; row < last; ++row, depth += kTileSize, id = id_after<kShows>(id, kTileSize)) {
                const F32x8 down_here = y * per_pixel_y;
                SIMD_FOR (int r = 0; r < kAcross; ++r) {
                    const MaskX8 inside = (edge[0][r] | edge[1][r] | edge[2][r]) > I32x8(-1);
                    show_samples<kShows>({}, inside, base[r] + (rest[r] + (across[r] + down_here)),
                                         name, depth + r * kLanesX8,
                                         id_after<kShows>(id, r * kLanesX8), shows);
                    SIMD_FOR (int k = 0; k < 3; ++k)
                        edge[k][r] = edge[k][r] + down[k];
                }
                y = y + F32x8(1.0F);
            }
            y = y - F32x8(kSide);
        }
    }
    drawn = drawn | shows;
}

template <Shows kShows>
SIMD_INLINE void draw_strips(const TilePlanes& tile, const SetUpPartsX8& s, I32x8 x0,
                             std::uint32_t live, Blocks& b, I32x8& drawn) {
    constexpr int kSide = BlockWalk::kSide;
    const PartLanesX8& part = s.part;
    const I32x8 x1 = minimum(part.x1, x0 + I32x8(kSide));
    Strips strips;
    const std::uint32_t seen = set_up_depth(tile, s, x0, x1, live, strips);
    if (seen == 0) return;
    store(x1 - x0, strips.across);
    store(part.y1 - part.y0, strips.down);
    store(x0 & I32x8(kSide - 1), strips.column);
    store(part.y0 - part.top, strips.row);
    store(to_f32(part.y0 - part.top), strips.first_row);
    store(part.y0 * I32x8(kTileSize) + x0, b.place);
    SIMD_FOR (int k = 0; k < 3; ++k) {
        store(shift_left<kSubpixelBits>(s.edges.a[k]), b.per_x[k]);
        store(shift_left<kSubpixelBits>(s.edges.b[k]), b.per_y[k]);
    }
    set_up_strip_edges(tile, s.edges, x0 - part.left, part.y0 - part.top, strips.first);
    const auto draw = [&](const auto& samples) SIMD_LAMBDA {
        for (std::uint32_t rest = seen; rest != 0; rest &= rest - 1) {
            const int lane = __builtin_ctz(rest);
            draw_strip<kShows>(tile, samples, b, strips, lane, part.name[lane], drawn);
        }
    };
    if (tile.pattern.size() == 1)
        draw(OneSample{tile.pattern.front()});
    else
        draw(ManySamples{tile.pattern});
}

template <Shows kShows>
SIMD_INLINE void draw_flat_parts(const TilePlanes& tile, const SetUpPartsX8& s, std::uint32_t live,
                                 I32x8& drawn) {
    Blocks b;
    store(I32x8(0), b.begin);
    store(to_f32(s.plane.per_x), b.per_pixel_x);
    store(to_f32(s.plane.per_y), b.per_pixel_y);
    for (I32x8 x = s.part.x0; live != 0; live &= bits(x < s.part.x1)) {
        draw_strips<kShows>(tile, s, x, live, b, drawn);
        x = x + I32x8(BlockWalk::kSide);
    }
}

SIMD_END

#endif
