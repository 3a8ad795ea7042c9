#include "raster/small_triangles.h"

#include <algorithm>

#define SIMD_FILE "raster/small_triangles.cpp"
#include "simd/for_each_target.h"

#include "raster/blocks-inl.h"
#include "raster/parts-inl.h"
#include "raster/specks-inl.h"

SIMD_BEGIN(scanout::raster)

using PartLanesX8 = PartLanes<F32x8::Tag>;
using PartEdgesX8 = PartEdges<F32x8::Tag>;
using SetUpPartsX8 = SetUpParts<F32x8::Tag>;

// For rows from `begin` on.
HWY_INLINE void set_up_samples(const PartEdgesX8& e, const I32x8 (&corner)[3], SampleOffset at,
                               I32x8 begin, Blocks& out) {
    I32x8 first[3];
    edges_at(e, corner, at, first);
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        const I32x8 per_y = shift_left<kSubpixelBits>(e.b[k]);
        store(first[k] + per_y * begin, out.first[k]);
        store(shift_left<kSubpixelBits>(e.a[k]), out.per_x[k]);
        store(per_y, out.per_y[k]);
    }
}

// Depth by the edge functions at every sample, in double (coverage.h).
template <Shows kShows>
HWY_INLINE void draw_steep_samples(const TilePlanes& tile, const PartLanesX8& part,
                                   const PartEdgesX8& edges, const F64x8 (&share)[3],
                                   std::uint32_t live, I32x8& drawn) {
    Blocks b;
    const I32x8 row = part.y0 - part.top;
    store(row, b.begin);
    store(part.top * I32x8(kTileSize) + part.left, b.place);
    std::ptrdiff_t plane = 0;
    const Few all{live, part.x0 - part.left, part.x1 - part.x0, part.y1 - part.y0};
    for (const SampleOffset* at = tile.pattern.data();
         at != tile.pattern.data() + tile.pattern.size();
         ++at, plane += std::ptrdiff_t{kTileSize} * kTileSize) {
        set_up_samples(edges, edges.c, *at, row, b);
        const auto depth = [&](const I32x8(&edge)[3], int, int) HWY_ATTR {
            const I32x8 true_edge[3] = {edge[0] - edges.bias[0], edge[1] - edges.bias[1],
                                        edge[2] - edges.bias[2]};
            return to_f32(depth_of(true_edge, share));
        };
        draw_pixels<kShows>(b, all, kSmallSide + 1, depth, part.name, tile.depth + plane,
                            id_after<kShows>(tile.id, plane), drawn);
    }
}

constexpr std::size_t kMostSamples = std::size(detail::kSixteen); // of a pixel
// Each way at most as many blocks hold a part.
constexpr int kMostBlocks = kSmallSide / BlockWalk::kSide + 1;

// Strips of flat parts, one a lane: as wide as a block, from a column of the part on. So most parts
// are one register a row, wherever in their blocks they lie. Depth still starts from the corner of
// the block that a pixel lies in.
struct Strips {
    std::int32_t across[kLanesX8], down[kLanesX8]; // pixels
    std::int32_t column[kLanesX8], row[kLanesX8];  // of the first pixel, in its block
    float base[kMostBlocks][2][kLanesX8];          // at the corners of blocks, downwards and
    float rest[kMostBlocks][2][kLanesX8];          // across (Blocks)
    std::int32_t first[kMostSamples][3][kLanesX8]; // the edges at the first pixel's samples
};

constexpr int kAcross = BlockWalk::kSide / kLanesX8; // registers, of a row

// The blocks' depths. Returns the lanes of which something may be seen.
HWY_INLINE std::uint32_t set_up_depth(const TilePlanes& tile, const SetUpPartsX8& s, I32x8 x0,
                                      I32x8 x1, std::uint32_t live, Strips& out) {
    constexpr int kSide = BlockWalk::kSide, kBlocks = kTileSize / kSide;
    const PartLanesX8& part = s.part;
    const I32x8 left = x0 & I32x8(-kSide), right = left + I32x8(kSide);
    I32x8 edge[3], step[3];
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        step[k] = shift_left<kSubpixelBits>(s.edges.a[k]);
        edge[k] = s.edges.c[k] + step[k] * (left - part.left);
    }
    std::uint32_t seen = tile.farthest == nullptr ? live : 0;
    I32x8 top = part.top;
    for (int down = 0; down < kMostBlocks; ++down) {
        const std::uint32_t here = live & bits(top < part.y1);
        if (here == 0) break;
        const std::uint32_t in_column[] = {here, here & bits(right < x1)};
        SIMD_UNROLL
        for (int across = 0; across < 2; ++across) {
            I32x8 corner[3];
            SIMD_UNROLL
            for (int k = 0; k < 3; ++k)
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
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            edge[k] = edge[k] + shift_left<kSubpixelBits>(s.edges.b[k]) * I32x8(kSide);
    }
    return seen;
}

// Row by row, at one sample after the other: how many rows there are is foretold from the second
// sample on.
template <Shows kShows>
HWY_INLINE void draw_strip(const TilePlanes& tile, const Blocks& b, const Strips& s, int lane,
                           std::uint32_t name, I32x8& drawn) {
    constexpr int kSide = BlockWalk::kSide;
    const F32x8 per_pixel_x = b.per_pixel_x[lane], per_pixel_y = b.per_pixel_y[lane];
    I32x8 from_first[3][kAcross], down[3];
    F32x8 column[kAcross];
    MaskX8 right[kAcross];
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        down[k] = b.per_y[k][lane];
    SIMD_UNROLL
    for (int r = 0; r < kAcross; ++r) {
        const I32x8 number = iota<I32x8>(r * kLanesX8), in_block = number + s.column[lane];
        right[r] = in_block >= I32x8(kSide);
        column[r] = to_f32(in_block & I32x8(kSide - 1));
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            from_first[k][r] = I32x8(b.per_x[k][lane]) * number;
        const I32x8 outside = -(1 << 30); // and stays so: what is added is less than 2^29
        from_first[0][r] = select(number < I32x8(s.across[lane]), from_first[0][r], outside);
    }
    I32x8 shows = 0;
    std::ptrdiff_t first = b.place[lane]; // pixel of the plane
    for (std::size_t n = 0; n < tile.pattern.size();
         ++n, first += std::ptrdiff_t{kTileSize} * kTileSize) {
        const SampleOffset at = tile.pattern.data()[n];
        const F32x8 sample_x = static_cast<float>(at.x) / kSubpixel;
        I32x8 edge[3][kAcross];
        F32x8 across[kAcross];
        SIMD_UNROLL
        for (int r = 0; r < kAcross; ++r) {
            across[r] = (column[r] + sample_x) * per_pixel_x;
            SIMD_UNROLL
            for (int k = 0; k < 3; ++k)
                edge[k][r] = I32x8(s.first[n][k][lane]) + from_first[k][r];
        }
        float* depth = tile.depth + first;
        std::uint32_t* id = id_after<kShows>(tile.id, first);
        int row = s.row[lane];
        const int end = row + s.down[lane];
        F32x8 y = static_cast<float>(row) + static_cast<float>(at.y) / kSubpixel;
        for (int block = 0; row < end; ++block) {
            F32x8 base[kAcross], rest[kAcross];
            SIMD_UNROLL
            for (int r = 0; r < kAcross; ++r) {
                base[r] =
                    select(right[r], F32x8(s.base[block][1][lane]), F32x8(s.base[block][0][lane]));
                rest[r] =
                    select(right[r], F32x8(s.rest[block][1][lane]), F32x8(s.rest[block][0][lane]));
            }
            const int last = (block + 1) * kSide < end ? (block + 1) * kSide : end;
            for (; row < last; ++row, depth += kTileSize, id = id_after<kShows>(id, kTileSize)) {
                const F32x8 down_here = y * per_pixel_y;
                SIMD_UNROLL
                for (int r = 0; r < kAcross; ++r) {
                    const MaskX8 inside = (edge[0][r] | edge[1][r] | edge[2][r]) > I32x8(-1);
                    show_samples<kShows>({}, inside, base[r] + (rest[r] + (across[r] + down_here)),
                                         name, depth + r * kLanesX8,
                                         id_after<kShows>(id, r * kLanesX8), shows);
                    SIMD_UNROLL
                    for (int k = 0; k < 3; ++k)
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
HWY_INLINE void draw_strips(const TilePlanes& tile, const SetUpPartsX8& s, I32x8 x0,
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
    store(part.y0 * I32x8(kTileSize) + x0, b.place);
    I32x8 first[3];
    edges_at_pixel(s.edges, x0 - part.left, part.y0 - part.top, first);
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        store(shift_left<kSubpixelBits>(s.edges.a[k]), b.per_x[k]);
        store(shift_left<kSubpixelBits>(s.edges.b[k]), b.per_y[k]);
    }
    for (std::size_t n = 0; n < tile.pattern.size(); ++n) {
        I32x8 at[3];
        edges_at(s.edges, first, tile.pattern.data()[n], at);
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            store(at[k], strips.first[n][k]);
    }
    for (std::uint32_t rest = seen; rest != 0; rest &= rest - 1) {
        const int lane = __builtin_ctz(rest);
        draw_strip<kShows>(tile, b, strips, lane, part.name[lane], drawn);
    }
}

template <Shows kShows>
HWY_INLINE void draw_flat_parts(const TilePlanes& tile, const SetUpPartsX8& s, std::uint32_t live,
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

// Steep parts of a list, which wait until they fill a register.
template <int kWidth>
class SteepParts {
public:
    // Those of a register whose bit is set. draw(parts): as many as fill one.
    template <class Draw>
    HWY_INLINE void add(const TilePart* first, std::uint32_t some, const Draw& draw) {
        for (; some != 0; some &= some - 1) {
            part_[count_++] = first[__builtin_ctz(some)];
            if (count_ == kWidth) finish(draw);
        }
    }
    template <class Draw>
    HWY_INLINE void finish(const Draw& draw) {
        if (count_ > 0) draw(std::span<const TilePart>(part_, static_cast<std::size_t>(count_)));
        count_ = 0;
    }

private:
    TilePart part_[kWidth];
    int count_ = 0;
};

// A register of them at most.
template <class D>
HWY_INLINE void set_up_some(const TilePlanes& tile, const TilePartList& of,
                            std::span<const TilePart> some, SetUpParts<D>& out) {
    const TilePartList list{of.vertices, of.index, some};
    PartCorners<D> corner;
    read_corners(list, 0, corner);
    set_up_parts(tile, list, some.data(), static_cast<int>(some.size()), corner, out);
}

// Any part.
template <Shows kShows>
struct AsStrips {
    using Tag = F32x8::Tag;
    SteepParts<kLanesX8> steep;

    static HWY_NOINLINE void draw_steep(const TilePlanes& tile, const TilePartList& list,
                                        std::span<const TilePart> some, I32x8& drawn) {
        SetUpPartsX8 s;
        set_up_some(tile, list, some, s);
        draw_steep_samples<kShows>(tile, s.part, s.edges, s.plane.share, s.live, drawn);
    }
    HWY_INLINE void draw(const TilePlanes& tile, const TilePartList& list, const SetUpPartsX8& s,
                         const TilePart* first, I32x8& drawn) {
        const std::uint32_t some = s.live & ~s.plane.flat;
        if (__builtin_popcount(some) >= kLanesX8 / 2)
            draw_steep_samples<kShows>(tile, s.part, s.edges, s.plane.share, some, drawn);
        else
            steep.add(first, some,
                      [&](auto parts) HWY_ATTR { draw_steep(tile, list, parts, drawn); });
        draw_flat_parts<kShows>(tile, s, s.live & s.plane.flat, drawn);
    }
    HWY_INLINE void finish(const TilePlanes& tile, const TilePartList& list, I32x8& drawn) {
        steep.finish([&](auto parts) HWY_ATTR { draw_steep(tile, list, parts, drawn); });
    }
};

template <Shows kShows, PartKind kKind>
struct AsSpecks {
    using Tag = F32::Tag;
    SpeckBatch<speck_side(kKind)> batch;
    SteepParts<kLanes> steep;

    HWY_NOINLINE void add_steep(const TilePlanes& tile, const TilePartList& list,
                                std::span<const TilePart> some, I32x8& drawn) {
        SetUpParts<Tag> s;
        set_up_some(tile, list, some, s);
        add_specks<SteepSpeckDepths, kShows>(tile, s, s.live, batch, drawn);
    }
    HWY_INLINE void draw(const TilePlanes& tile, const TilePartList& list, const SetUpParts<Tag>& s,
                         const TilePart* first, I32x8& drawn) {
        steep.add(first, s.live & ~s.plane.flat,
                  [&](auto parts) HWY_ATTR { add_steep(tile, list, parts, drawn); });
        add_specks<SpeckDepths<kKind == PartKind::speck_astride>, kShows>(
            tile, s, s.live & s.plane.flat, batch, drawn);
    }
    HWY_INLINE void finish(const TilePlanes& tile, const TilePartList& list, I32x8& drawn) {
        steep.finish([&](auto parts) HWY_ATTR { add_steep(tile, list, parts, drawn); });
        draw_batch<kShows>(tile, batch, drawn);
    }
};

// A register is set up before the one in front of it is drawn. Drawing branches on what nobody
// could foretell; were it the end of a set-up that it waits for, the next one could not have begun
// either.
template <Shows kShows, class As>
HWY_INLINE bool draw_list(const TilePlanes& tile, const TilePartList& list) {
    using Tag = typename As::Tag;
    constexpr int kWidth = static_cast<int>(Int<Tag>::kLanes);
    I32x8 drawn = 0;
    As as;
    const TilePart* const parts = list.parts.data();
    const auto all = static_cast<int>(list.parts.size());
    PartCorners<Tag> corner, next;
    read_corners(list, 0, next);
    SetUpParts<Tag> room[2];
    for (int begin = 0; begin < all + kWidth; begin += kWidth) {
        const int number = begin / kWidth, left = all - begin;
        if (left > 0) {
            corner = next;
            read_corners(list, begin + kWidth, next);
            set_up_parts(tile, list, parts + begin, left < kWidth ? left : kWidth, corner,
                         room[number & 1]);
        }
        if (begin == 0) continue;
        as.draw(tile, list, room[(number & 1) ^ 1], parts + begin - kWidth, drawn);
    }
    as.finish(tile, list, drawn);
    return any(!(drawn == I32x8(0)));
}

template <Shows kShows>
HWY_INLINE bool draw_kind(const TilePlanes& tile, const TilePartList& list) {
    switch (list.kind) {
    case PartKind::speck_2:
        return draw_list<kShows, AsSpecks<kShows, PartKind::speck_2>>(tile, list);
    case PartKind::speck_3:
        return draw_list<kShows, AsSpecks<kShows, PartKind::speck_3>>(tile, list);
    case PartKind::speck_astride:
        return draw_list<kShows, AsSpecks<kShows, PartKind::speck_astride>>(tile, list);
    case PartKind::strip:
    case PartKind::back:
        break;
    }
    return draw_list<kShows, AsStrips<kShows>>(tile, list);
}
bool draw_all_parts(const TilePlanes& tile, const TilePartList& list) {
    return tile.id == nullptr ? draw_kind<Shows::depth>(tile, list)
                              : draw_kind<Shows::usual>(tile, list);
}

// Of the blocks that parts may touch the one with the farthest depth.
HWY_INLINE F32x8 farthest_of(const TilePlanes& tile, I32x8 where) {
    using P = TilePart;
    constexpr int kBlocks = kTileSize / BlockWalk::kSide;
    const auto block_of = [](I32x8 pixel) { return shift_right<3>(pixel); };
    const I32x8 x0 = block_of(where & I32x8(63)),
                y0 = block_of(shift_right<P::kFirstRow>(where) & I32x8(63)),
                x1 = block_of((shift_right<P::kEndColumn>(where) & I32x8(127)) - I32x8(1)),
                y1 = block_of(shift_right<P::kEndRow>(where) - I32x8(1));
    F32x8 farthest = 0x1p127F;
    for (I32x8 y = y0; any(y <= y1); y = y + I32x8(1))
        for (I32x8 x = x0; any(x <= x1); x = x + I32x8(1)) {
            const I32x8 block = minimum(y, y1) * I32x8(kBlocks) + minimum(x, x1);
            farthest = minimum(farthest, gather(tile.farthest, block));
        }
    return farthest;
}

// Parts that lie behind all that is seen in their blocks go; those that are left are counted.
int drop_hidden(const TilePlanes& tile, const TilePartList& list, TilePart* out) {
    const auto* real = reinterpret_cast<const double*>(list.vertices.data());
    const auto all = static_cast<int>(list.parts.size());
    int left = 0;
    PartCorners<F32x8::Tag> corner, next;
    read_corners(list, 0, next);
    for (int begin = 0; begin < all; begin += kLanesX8) {
        const TilePart* part = list.parts.data() + begin;
        const int count = all - begin < kLanesX8 ? all - begin : kLanesX8;
        corner = next;
        read_corners(list, begin + kLanesX8, next);
        F64x8 nearest = 0.0;
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            nearest = maximum(nearest, gather(real + 1, shift_left<1>(load<I32x8>(corner.at[k]))));
        const F32x8 farthest = farthest_of(tile, stored_parts<F32x8::Tag>(part, count).where);
        std::uint32_t rest =
            bits(to_f32(nearest * F64x8(1 + 0x1p-20)) >= farthest) & ((2U << (count - 1)) - 1);
        for (; rest != 0; rest &= rest - 1)
            out[left++] = part[__builtin_ctz(rest)];
    }
    return left;
}

void find_farthest_of_all(const TilePlanes& tile) {
    constexpr int kSide = BlockWalk::kSide, kBlocks = kTileSize / kSide;
    for (int y = 0; y < kBlocks; ++y)
        for (int x = 0; x < kBlocks; ++x)
            tile.farthest[y * kBlocks + x] = farthest_in(tile, (y * kTileSize + x) * kSide);
}

bool hidden_in_blocks(const TilePlanes& tile, int x0, int y0, int x1, int y1, float nearest) {
    constexpr int kBlocks = kTileSize / BlockWalk::kSide;
    for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x)
            if (!(nearest < tile.farthest[y * kBlocks + x]) && !hides_by_now(tile, x, y, nearest))
                return false;
    return true;
}

template <int kTileBits>
HWY_INLINE void place_lanes(const TileGrid& grid, const std::uint32_t* triangle, std::int32_t* tile,
                            std::uint32_t* where, std::int32_t* kind) {
    I32 name, from, to;
    load_interleaved(triangle, name, from, to);
    const I32 half = 0xffff, one = 1, below_flag = 0x7fff;
    const I32 x0 = from & below_flag, y0 = shift_right<16>(from) & below_flag;
    const I32 x1 = to & half, y1 = shift_right<16>(to);
    const I32 tile_x = shift_right<kTileBits>(x0), tile_y = shift_right<kTileBits>(y0);
    const auto one_tile =
        (tile_x == shift_right<kTileBits>(x1 - one)) & (tile_y == shift_right<kTileBits>(y1 - one));
    const I32 left = shift_left<kTileBits>(tile_x), top = shift_left<kTileBits>(tile_y);
    store((x0 - left) | shift_left<TilePart::kFirstRow>(y0 - top) |
              shift_left<TilePart::kEndColumn>(x1 - left) | shift_left<TilePart::kEndRow>(y1 - top),
          where);
    const I32 number = tile_y * I32(grid.across) + tile_x;
    store(select(one_tile & (from < I32(0)), number, I32(PlacedParts::kNone)), tile);
    const auto one_block = (shift_right<3>(x0) == shift_right<3>(x1 - one)) &
                           (shift_right<3>(y0) == shift_right<3>(y1 - one));
    const I32 most = maximum(x1 - x0, y1 - y0);
    const auto is = [](PartKind of) HWY_ATTR { return I32(static_cast<std::int32_t>(of)); };
    constexpr int kSide2 = speck_side(PartKind::speck_2), kSide3 = speck_side(PartKind::speck_3);
    const I32 speck = select(most <= I32(kSide2), is(PartKind::speck_2), is(PartKind::speck_3));
    const I32 tiny = select(one_block, speck, is(PartKind::speck_astride));
    const I32 front = select(most <= I32(kSide3), tiny, is(PartKind::strip));
    const auto away = !((from & I32(static_cast<std::int32_t>(KeptTriangle::kAway))) == I32(0));
    store(select(away, is(PartKind::back), front), kind);
}

template <int kTileBits>
HWY_INLINE void place_each(const TileGrid& grid, const std::uint32_t* triangle, int count,
                           std::int32_t* tile, std::uint32_t* where, std::int32_t* kind) {
    for (int i = 0; i < count; i += kLanes)
        place_lanes<kTileBits>(grid, triangle + std::ptrdiff_t{i} * 3, tile + i, where + i,
                               kind + i);
}
void place_all(const TileGrid& grid, const std::uint32_t* triangle, int count, std::int32_t* tile,
               std::uint32_t* where, std::int32_t* kind) {
    if (grid.bits == 6) place_each<6>(grid, triangle, count, tile, where, kind);
    if (grid.bits == 5) place_each<5>(grid, triangle, count, tile, where, kind);
    if (grid.bits == 4) place_each<4>(grid, triangle, count, tile, where, kind);
    if (grid.bits == 3) place_each<3>(grid, triangle, count, tile, where, kind);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(draw_all_parts);
SIMD_REGISTER(drop_hidden);
SIMD_REGISTER(find_farthest_of_all);
SIMD_REGISTER(hidden_in_blocks);
SIMD_REGISTER(place_all);

void place_parts(const TileGrid& grid, std::span<const KeptTriangle> triangles, PlacedParts& out) {
    static_assert(sizeof(KeptTriangle) == 3 * sizeof(std::uint32_t));
    if (out.tile.size() < triangles.size() + kRegisterRoom) {
        out.tile.resize(triangles.size() + kRegisterRoom);
        out.where.resize(triangles.size() + kRegisterRoom);
        out.kind.resize(triangles.size() + kRegisterRoom);
    }
    SIMD_CALL(place_all)
    (grid, &triangles.data()->triangle, static_cast<int>(triangles.size()), out.tile.data(),
     out.where.data(), out.kind.data());
}

bool draw_parts(const TilePlanes& tile, const TilePartList& list) {
    return SIMD_CALL(draw_all_parts)(tile, list);
}

void find_farthest(const TilePlanes& tile) {
    SIMD_CALL(find_farthest_of_all)(tile);
}

bool hides(const TilePlanes& tile, const image::Rect& pixels, float nearest) {
    constexpr int kSide = BlockWalk::kSide;
    const auto first = [](int at, int begin) { return std::max(at - begin, 0) / kSide; };
    const auto end = [](int at, int begin) { return (at - begin + kSide - 1) / kSide; };
    const image::Rect& a = tile.area;
    return SIMD_CALL(hidden_in_blocks)(tile, first(pixels.x0, a.x0), first(pixels.y0, a.y0),
                                       end(std::min(pixels.x1, a.x1), a.x0),
                                       end(std::min(pixels.y1, a.y1), a.y0), nearest);
}

bool draw_parts_behind(const TilePlanes& tile, const TilePartList& list,
                       std::vector<TilePart>& room) {
    if (room.size() < list.parts.size()) room.resize(list.parts.size());
    const int left = SIMD_CALL(drop_hidden)(tile, list, room.data());
    const auto seen = std::span<const TilePart>(room).first(static_cast<std::size_t>(left));
    return draw_parts(tile, {list.vertices, list.index, seen});
}

} // namespace scanout::raster
#endif
