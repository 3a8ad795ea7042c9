#include "raster/small_triangles.h"

#include <algorithm>

#define SIMD_FILE "raster/small_triangles.cpp"
#include "simd/for_each_target.h"

#include "raster/part_lists-inl.h"

SIMD_BEGIN(scanout::raster)

bool draw_all_parts(const TilePlanes& tile, const TilePartList& list) {
    if (tile.id != nullptr) return draw_kind<Shows::usual>(tile, list);
    return draw_kind<Shows::depth>(tile, {list.vertices, list.index, list.parts, list.kind});
}

constexpr int kMostOrdered = 512; // at a time

// By counting.
SIMD_INLINE void order_some(TilePart* parts, int count) {
    constexpr int kSide = BlockWalk::kSide;
    constexpr int kHeights = 8, kLeast = 3; // up to 3 rows, 4, 5, ..., 9, and 10 or more
    std::uint32_t sort[kMostOrdered + kLanes], next[kHeights * kSide] = {};
    TilePart ordered[kMostOrdered];
    for (int i = 0; i < count; i += kLanes) {
        const int left = count - i < kLanes ? count - i : kLanes;
        const I32 where = stored_parts<F32::Tag>(parts + i, left).where;
        const I32 y0 = shift_right<TilePart::kFirstRow>(where) & I32(63),
                  rows = shift_right<TilePart::kEndRow>(where) - y0;
        const I32 height = minimum(maximum(rows - I32(kLeast), I32(0)), I32(kHeights - 1));
        store(height * I32(kSide) + (y0 & I32(kSide - 1)), sort + i);
    }
    for (int i = 0; i < count; ++i)
        ++next[sort[i]];
    std::uint32_t sum = 0;
    for (std::uint32_t& first : next) {
        const std::uint32_t here = first;
        first = sum;
        sum += here;
    }
    for (int i = 0; i < count; ++i)
        ordered[next[sort[i]]++] = parts[i];
    __builtin_memcpy(parts, ordered, static_cast<std::size_t>(count) * sizeof *parts);
}
void order_all(TilePart* parts, int count) {
    for (int i = 0; i < count; i += kMostOrdered)
        order_some(parts + i, count - i < kMostOrdered ? count - i : kMostOrdered);
}

// Of the blocks that parts may touch the one with the farthest depth.
SIMD_INLINE F32x8 farthest_of(const TilePlanes& tile, I32x8 where) {
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
        SIMD_FOR (int k = 0; k < 3; ++k)
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
SIMD_INLINE void place_lanes(const TileGrid& grid, const std::uint32_t* triangle,
                             std::int32_t* tile, std::uint32_t* where, std::int32_t* kind) {
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
    const auto is = [](PartKind of) SIMD_LAMBDA { return I32(static_cast<std::int32_t>(of)); };
    constexpr int kSide2 = speck_side(PartKind::speck_2), kSide3 = speck_side(PartKind::speck_3);
    const I32 speck = select(most <= I32(kSide2), is(PartKind::speck_2), is(PartKind::speck_3));
    const I32 tiny = select(one_block, speck, is(PartKind::speck_astride));
    const I32 front = select(most <= I32(kSide3), tiny, is(PartKind::strip));
    const auto away = !((from & I32(static_cast<std::int32_t>(KeptTriangle::kAway))) == I32(0));
    store(select(away, is(PartKind::back), front), kind);
}

template <int kTileBits>
SIMD_INLINE void place_each(const TileGrid& grid, const std::uint32_t* triangle, int count,
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
SIMD_REGISTER(order_all);
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
    SIMD_CALL(place_all, grid, &triangles.data()->place, static_cast<int>(triangles.size()),
              out.tile.data(), out.where.data(), out.kind.data());
}

void order_strips(std::span<TilePart> parts) {
    constexpr std::size_t kFew = 32; // are not worth it
    if (parts.size() >= kFew) SIMD_CALL(order_all, parts.data(), static_cast<int>(parts.size()));
}

bool draw_parts(const TilePlanes& tile, const TilePartList& list) {
    return SIMD_CALL(draw_all_parts, tile, list);
}

void find_farthest(const TilePlanes& tile) {
    SIMD_CALL(find_farthest_of_all, tile);
}

bool hides(const TilePlanes& tile, const image::Rect& pixels, float nearest) {
    constexpr int kSide = BlockWalk::kSide;
    const auto first = [](int at, int begin) { return std::max(at - begin, 0) / kSide; };
    const auto end = [](int at, int begin) { return (at - begin + kSide - 1) / kSide; };
    const image::Rect& a = tile.area;
    return SIMD_CALL(hidden_in_blocks, tile, first(pixels.x0, a.x0), first(pixels.y0, a.y0),
                     end(std::min(pixels.x1, a.x1), a.x0), end(std::min(pixels.y1, a.y1), a.y0),
                     nearest);
}

bool draw_parts_behind(const TilePlanes& tile, const TilePartList& list,
                       std::vector<TilePart>& room) {
    if (room.size() < list.parts.size()) room.resize(list.parts.size());
    const int left = SIMD_CALL(drop_hidden, tile, list, room.data());
    const auto seen = std::span<const TilePart>(room).first(static_cast<std::size_t>(left));
    return draw_parts(tile, {list.vertices, list.index, seen, PartKind::strip, list.id});
}

} // namespace scanout::raster
#endif
