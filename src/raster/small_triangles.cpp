#include "raster/small_triangles.h"

#define SIMD_FILE "raster/small_triangles.cpp"
#include "simd/for_each_target.h"

#include "raster/blocks-inl.h"

SIMD_BEGIN(scanout::raster)

// A vertex relative to the corner of a block: x + 2^16 y, both below 2^14, and its depth.
struct NearCorner {
    F64x8 place, depth;
};

HWY_INLINE void sort_two(NearCorner& a, NearCorner& b) {
    const auto turn = b.place < a.place;
    exchange(turn, a.place, b.place);
    exchange(turn, a.depth, b.depth);
}

// The parts of a register.
struct PartLanes {
    I32x8 column, end_column, row, end_row; // pixels of the block
    I32x8 block, left, top;                 // pixels of the tile
    NearCorner vertex[3];
    std::uint32_t name[kLanesX8];
};

// The vertices of a register of parts.
struct PartCorners {
    std::uint32_t at[3][kLanesX8];
};
// Parts of a tile lie far apart in memory. So before a register of them is needed its vertices are
// asked for, and the indices of those that are two registers further on.
HWY_INLINE void read_corners(const BlockPartList& list, int first, PartCorners& out) {
    const auto last = static_cast<int>(list.parts.size()) - 1;
    if (first > last) return;
    const auto index = [&](int i) {
        return list.index.data() + std::size_t{list.parts.data()[i < last ? i : last].triangle} * 3;
    };
    for (int i = 0; i < kLanesX8; ++i) {
        const std::uint32_t* corner = index(first + i);
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k) {
            out.at[k][i] = corner[k];
            __builtin_prefetch(list.vertices.data() + corner[k]);
        }
        __builtin_prefetch(index(first + i + 2 * kLanesX8));
    }
}

// A register of parts; the last stands for what is missing.
struct StoredParts {
    I32x8 triangle, where;
};
HWY_INLINE StoredParts stored_parts(const BlockPart* part, int count) {
    static_assert(sizeof(BlockPart) == 8);
    const I32x8 at = shift_left<1>(minimum(iota<I32x8>(0), I32x8(count - 1)));
    const auto* stored = reinterpret_cast<const std::int32_t*>(part);
    return {gather(stored, at), gather(stored + 1, at)};
}

HWY_INLINE void load_parts(const TilePlanes& tile, const BlockPartList& list, const BlockPart* part,
                           int count, const PartCorners& corner, PartLanes& out) {
    using P = BlockPart;
    const StoredParts s = stored_parts(part, count);
    const I32x8 where = s.where;
    store(s.triangle, out.name);
    out.column = shift_right<P::kFirstColumn>(where) & I32x8(15);
    out.end_column = shift_right<P::kEndColumn>(where) & I32x8(15);
    out.row = shift_right<P::kFirstRow>(where) & I32x8(15);
    out.end_row = shift_right<P::kEndRow>(where);
    out.block = where & I32x8(63);
    out.left = shift_left<3>(where & I32x8(7));
    out.top = shift_left<3>(shift_right<3>(out.block));
    const I32x8 corner_x = shift_left<kSubpixelBits>(out.left + I32x8(tile.area.x0));
    const I32x8 corner_y = shift_left<kSubpixelBits>(out.top + I32x8(tile.area.y0));
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        const auto v = vertices_at<F32x8>(list.vertices.data(), corner.at[k]);
        const I32x8 x = v.word(0) - corner_x, y = v.word(1) - corner_y;
        out.vertex[k].place = to_f64(shift_left<16>(y) + x);
        out.vertex[k].depth = v.last_double();
    }
}

// Edge functions a x + b y + c, positive inside, from the corner of the block on; below 2^28.
struct PartEdges {
    I32x8 a[3], b[3], c[3];
    I32x8 area; // twice the triangle's
};

HWY_INLINE PartEdges edges_of(const PartLanes& part) {
    I32x8 x[3], y[3];
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        const I32x8 place = to_i32(part.vertex[k].place);
        y[k] = shift_right<16>(place + I32x8(1 << 15));
        x[k] = place - shift_left<16>(y[k]);
    }
    const I32x8 twice = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
    const MaskX8 turned = twice < I32x8(0);
    PartEdges e;
    e.area = select(turned, I32x8(0) - twice, twice);
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        const int from = k == 2 ? 0 : k + 1, to = k == 0 ? 2 : k - 1;
        const I32x8 a = y[from] - y[to], b = x[to] - x[from];
        e.a[k] = select(turned, I32x8(0) - a, a);
        e.b[k] = select(turned, I32x8(0) - b, b);
        e.c[k] = I32x8(0) - (e.a[k] * x[from] + e.b[k] * y[from]);
    }
    return e;
}

// The top-left rule.
HWY_INLINE I32x8 bias_of(I32x8 a, I32x8 b) {
    return select(is_top_left(a, b), I32x8(0), I32x8(-1));
}

// The samples of one place in the pattern.
HWY_INLINE void set_up_samples(const PartEdges& e, SampleOffset at, I32x8 begin, Blocks& out) {
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        const I32x8 per_y = shift_left<kSubpixelBits>(e.b[k]);
        const I32x8 first =
            (e.c[k] + bias_of(e.a[k], e.b[k])) + (e.a[k] * I32x8(at.x) + e.b[k] * I32x8(at.y));
        store(first + per_y * begin, out.first[k]);
        store(shift_left<kSubpixelBits>(e.a[k]), out.per_x[k]);
        store(per_y, out.per_y[k]);
    }
}

HWY_INLINE void draw_samples(const TilePlanes& tile, const PartLanes& part, const PartEdges& edges,
                             const Few& few, std::uint32_t live, Blocks& b, I32x8& drawn) {
    std::size_t plane = 0;
    for (const SampleOffset* at = tile.pattern.data();
         at != tile.pattern.data() + tile.pattern.size();
         ++at, plane += std::size_t{kTileSize} * kTileSize) {
        set_up_samples(edges, *at, part.row, b);
        if (few.lanes != 0)
            draw_few(b, few, *at, part.name, tile.depth + plane, tile.id + plane, drawn);
        for (std::uint32_t rest = live & ~few.lanes; rest != 0; rest &= rest - 1) {
            const int lane = __builtin_ctz(rest);
            const std::size_t first = plane + static_cast<std::size_t>(b.place[lane]);
            draw_rows<true>(tile.rule, b, lane, *at, part.name[lane], tile.depth + first,
                            tile.id + first, drawn);
        }
    }
}

// Depth by the edge functions at every sample, in double (coverage.h).
HWY_INLINE void draw_steep_samples(const TilePlanes& tile, const PartLanes& part,
                                   const PartEdges& edges, const F64x8 (&share)[3],
                                   std::uint32_t live, Blocks& b, I32x8& drawn) {
    std::size_t plane = 0;
    const Few few{live, part.column, part.end_column - part.column, part.end_row - part.row};
    for (const SampleOffset* at = tile.pattern.data();
         at != tile.pattern.data() + tile.pattern.size();
         ++at, plane += std::size_t{kTileSize} * kTileSize) {
        set_up_samples(edges, *at, part.row, b);
        const auto depth = [&](const I32x8(&edge)[3], int, int) HWY_ATTR {
            F64x8 term[3];
            SIMD_UNROLL
            for (int k = 0; k < 3; ++k)
                term[k] = to_f64(edge[k] - bias_of(edges.a[k], edges.b[k])) * share[k];
            return to_f32((term[0] + term[1]) + term[2]);
        };
        draw_pixels(b, few, BlockWalk::kSide, depth, part.name, tile.depth + plane, tile.id + plane,
                    drawn);
    }
}

// A register of parts with what both kinds need.
struct SetUpParts {
    PartLanes part;
    PartEdges edges;
    DepthPlane plane;
    F64x8 depth;        // at the block's corner
    std::uint32_t live; // has an area, and may be seen
};
HWY_INLINE void set_up_parts(const TilePlanes& tile, const BlockPartList& list,
                             const BlockPart* first, int count, const PartCorners& corner,
                             SetUpParts& s) {
    load_parts(tile, list, first, count, corner, s.part);
    put_in_order(s.part.vertex);
    s.edges = edges_of(s.part);
    F64x8 a[3], b[3], at_corner[3];
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        a[k] = to_f64(s.edges.a[k]);
        b[k] = to_f64(s.edges.b[k]);
        at_corner[k] = to_f64(s.edges.c[k]);
    }
    const NearCorner(&v)[3] = s.part.vertex;
    s.plane =
        depth_plane({v[0].depth, v[1].depth, v[2].depth}, a, b, to_f64(maximum(s.edges.area, 1)));
    const F64x8(&share)[3] = s.plane.share;
    s.depth = (at_corner[0] * share[0] + at_corner[1] * share[1]) + at_corner[2] * share[2];
    s.live = bits(s.edges.area > I32x8(0)) & ((2U << (count - 1)) - 1);
    if (tile.farthest != nullptr)
        s.live &= ~hidden(tile, s.part.block, s.depth, reach_of(s.plane.per_x, s.plane.per_y));
}

HWY_INLINE void store_rows(const PartLanes& part, Blocks& b) {
    store(part.row, b.begin);
    store(part.end_row, b.end);
    store(part.top * I32x8(kTileSize) + part.left, b.place);
}

// Returns how many of them are steep and few: those are added to the list and not drawn.
HWY_INLINE int draw_most(const TilePlanes& tile, const BlockPartList& list, const BlockPart* first,
                         int count, const PartCorners& corner, I32x8& drawn, BlockPart* steep) {
    SetUpParts s;
    set_up_parts(tile, list, first, count, corner, s);
    Blocks b;
    store_rows(s.part, b);
    int left = 0;
    std::uint32_t rest = s.live & ~s.plane.flat;
    if (__builtin_popcount(rest) >= kLanesX8 / 2)
        draw_steep_samples(tile, s.part, s.edges, s.plane.share, rest, b, drawn);
    else
        for (; rest != 0; rest &= rest - 1)
            steep[left++] = first[__builtin_ctz(rest)];
    const std::uint32_t live = s.live & s.plane.flat;
    if (live == 0) return left;
    const F32x8 base = to_f32(s.depth);
    store(base, b.base);
    store(to_f32(s.depth - to_f64(base)), b.rest);
    store(to_f32(s.plane.per_x), b.per_pixel_x);
    store(to_f32(s.plane.per_y), b.per_pixel_y);
    Few few{0, s.part.column, s.part.end_column - s.part.column, s.part.end_row - s.part.row};
    few.lanes = bits((few.across <= I32x8(kFew)) & (few.down <= I32x8(kFew))) & live;
    draw_samples(tile, s.part, s.edges, few, live, b, drawn);
    return left;
}

// A register of them at most.
HWY_INLINE void draw_steep_parts(const TilePlanes& tile, const BlockPartList& list, I32x8& drawn) {
    PartCorners corner;
    read_corners(list, 0, corner);
    SetUpParts s;
    set_up_parts(tile, list, list.parts.data(), static_cast<int>(list.parts.size()), corner, s);
    Blocks b;
    store_rows(s.part, b);
    draw_steep_samples(tile, s.part, s.edges, s.plane.share, s.live, b, drawn);
}

bool draw_all_parts(const TilePlanes& tile, const BlockPartList& list) {
    I32x8 drawn = 0;
    BlockPart steep[2 * kLanesX8]; // until they fill a register
    int waiting = 0;
    const auto draw_steep = [&](int count) HWY_ATTR {
        const std::span<const BlockPart> some(steep, static_cast<std::size_t>(count));
        draw_steep_parts(tile, {list.vertices, list.index, some}, drawn);
    };
    const auto all = static_cast<int>(list.parts.size());
    PartCorners corner, next;
    read_corners(list, 0, next);
    for (int begin = 0; begin < all; begin += kLanesX8) {
        const int count = all - begin < kLanesX8 ? all - begin : kLanesX8;
        corner = next;
        read_corners(list, begin + kLanesX8, next);
        waiting +=
            draw_most(tile, list, list.parts.data() + begin, count, corner, drawn, steep + waiting);
        if (waiting < kLanesX8) continue;
        draw_steep(kLanesX8);
        waiting -= kLanesX8;
        for (int i = 0; i < waiting; ++i)
            steep[i] = steep[kLanesX8 + i];
    }
    if (waiting > 0) draw_steep(waiting);
    return any(!(drawn == I32x8(0)));
}

// Parts that lie behind all that is seen in their blocks go; those that are left are counted.
int drop_hidden(const TilePlanes& tile, const BlockPartList& list, BlockPart* out) {
    const auto* real = reinterpret_cast<const double*>(list.vertices.data());
    const auto all = static_cast<int>(list.parts.size());
    int left = 0;
    PartCorners corner, next;
    read_corners(list, 0, next);
    for (int begin = 0; begin < all; begin += kLanesX8) {
        const BlockPart* part = list.parts.data() + begin;
        const int count = all - begin < kLanesX8 ? all - begin : kLanesX8;
        corner = next;
        read_corners(list, begin + kLanesX8, next);
        F64x8 nearest = 0.0;
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            nearest = maximum(nearest, gather(real + 1, shift_left<1>(load<I32x8>(corner.at[k]))));
        const F32x8 farthest = gather(tile.farthest, stored_parts(part, count).where & I32x8(63));
        std::uint32_t rest =
            bits(to_f32(nearest * F64x8(1 + 0x1p-20)) >= farthest) & ((2U << (count - 1)) - 1);
        for (; rest != 0; rest &= rest - 1)
            out[left++] = part[__builtin_ctz(rest)];
    }
    return left;
}

void find_farthest_of_all(const TilePlanes& tile) {
    constexpr int kSide = BlockWalk::kSide, kBlocks = kTileSize / kSide;
    for (int y = 0; y < kBlocks; ++y) {
        float column[kTileSize];
        for (int x = 0; x < kTileSize; x += kLanesX8) {
            const float* depth = tile.depth + y * kSide * kTileSize + x;
            F32x8 least = load<F32x8>(depth);
            for (std::size_t s = 0; s < tile.pattern.size(); ++s, depth += kTileSize * kTileSize)
                for (int row = 0; row < kSide; ++row)
                    least = minimum(least, load<F32x8>(depth + row * kTileSize));
            store(least, column + x);
        }
        for (int x = 0; x < kBlocks; ++x) {
            float least = column[x * kSide];
            for (int i = 1; i < kSide; ++i)
                least = column[x * kSide + i] < least ? column[x * kSide + i] : least;
            tile.farthest[y * kBlocks + x] = least;
        }
    }
}

template <int kTileBits>
HWY_INLINE void place_lanes(const BlockGrid& grid, const std::uint32_t* triangle,
                            std::int32_t* tile, std::uint32_t* where) {
    I32 name, from, to;
    load_interleaved(triangle, name, from, to);
    const I32 half = 0xffff, one = 1, in_block = BlockGrid::kSide - 1;
    const I32 below_flag = 0x7fff;
    const I32 x0 = from & below_flag, y0 = shift_right<16>(from) & below_flag;
    const I32 x1 = to & half, y1 = shift_right<16>(to);
    const auto block_of = [](I32 pixel) { return shift_right<BlockGrid::kSideBits>(pixel); };
    const I32 block_x = block_of(x0), block_y = block_of(y0);
    const auto one_block = (block_x == block_of(x1 - one)) & (block_y == block_of(y1 - one));
    const I32 in_tile = (1 << kTileBits) - 1;
    const I32 block = shift_left<BlockGrid::kSideBits>(block_y & in_tile) | (block_x & in_tile);
    const I32 left = x0 & in_block, top = y0 & in_block;
    store(block | shift_left<BlockPart::kFirstColumn>(left) |
              shift_left<BlockPart::kEndColumn>(left + (x1 - x0)) |
              shift_left<BlockPart::kFirstRow>(top) |
              shift_left<BlockPart::kEndRow>(top + (y1 - y0)),
          where);
    const I32 number =
        shift_right<kTileBits>(block_y) * I32(grid.across) + shift_right<kTileBits>(block_x);
    store(select(one_block & (from < I32(0)), number, I32(PlacedParts::kNone)), tile);
}

template <int kTileBits>
HWY_INLINE void place_each(const BlockGrid& grid, const std::uint32_t* triangle, int count,
                           std::int32_t* tile, std::uint32_t* where) {
    for (int i = 0; i < count; i += kLanes)
        place_lanes<kTileBits>(grid, triangle + std::ptrdiff_t{i} * 3, tile + i, where + i);
}
void place_all(const BlockGrid& grid, const std::uint32_t* triangle, int count, std::int32_t* tile,
               std::uint32_t* where) {
    if (grid.tile_bits == 3) place_each<3>(grid, triangle, count, tile, where);
    if (grid.tile_bits == 2) place_each<2>(grid, triangle, count, tile, where);
    if (grid.tile_bits == 1) place_each<1>(grid, triangle, count, tile, where);
    if (grid.tile_bits == 0) place_each<0>(grid, triangle, count, tile, where);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(draw_all_parts);
SIMD_REGISTER(drop_hidden);
SIMD_REGISTER(find_farthest_of_all);
SIMD_REGISTER(place_all);

void place_parts(const BlockGrid& grid, std::span<const KeptTriangle> triangles, PlacedParts& out) {
    static_assert(sizeof(KeptTriangle) == 3 * sizeof(std::uint32_t));
    if (out.tile.size() < triangles.size() + kRegisterRoom) {
        out.tile.resize(triangles.size() + kRegisterRoom);
        out.where.resize(triangles.size() + kRegisterRoom);
    }
    SIMD_CALL(place_all)
    (grid, &triangles.data()->triangle, static_cast<int>(triangles.size()), out.tile.data(),
     out.where.data());
}

bool draw_parts(const TilePlanes& tile, const BlockPartList& list) {
    return SIMD_CALL(draw_all_parts)(tile, list);
}

void find_farthest(const TilePlanes& tile) {
    SIMD_CALL(find_farthest_of_all)(tile);
}

bool draw_parts_behind(const TilePlanes& tile, const BlockPartList& list,
                       std::vector<BlockPart>& room) {
    if (room.size() < list.parts.size()) room.resize(list.parts.size());
    const int left = SIMD_CALL(drop_hidden)(tile, list, room.data());
    const auto seen = std::span<const BlockPart>(room).first(static_cast<std::size_t>(left));
    return draw_parts(tile, {list.vertices, list.index, seen});
}

} // namespace scanout::raster
#endif
