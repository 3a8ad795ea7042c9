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

// count: of the lanes; the last stands for what is missing.
HWY_INLINE void load_parts(const TilePlanes& tile, const BlockPartList& list, const BlockPart* part,
                           int count, PartLanes& out) {
    std::uint32_t corner[3][kLanesX8], packed[kLanesX8];
    for (int i = 0; i < kLanesX8; ++i) {
        const BlockPart& p = part[i < count ? i : count - 1];
        const std::uint32_t* index = list.index.data() + std::size_t{p.triangle} * 3;
        out.name[i] = p.triangle;
        packed[i] = p.where;
        SIMD_UNROLL
        for (int k = 0; k < 3; ++k)
            corner[k][i] = index[k];
    }
    using P = BlockPart;
    const I32x8 where = load<I32x8>(packed);
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
        const auto v = vertices_at<F32x8>(list.vertices.data(), corner[k]);
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
                             const BlockPart* first, int count, SetUpParts& s) {
    load_parts(tile, list, first, count, s.part);
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

// Returns how many of them are steep: those are added to the list and not drawn.
HWY_INLINE int draw_near_to_flat(const TilePlanes& tile, const BlockPartList& list,
                                 const BlockPart* first, int count, I32x8& drawn,
                                 BlockPart* steep) {
    SetUpParts s;
    set_up_parts(tile, list, first, count, s);
    int left = 0;
    for (std::uint32_t rest = s.live & ~s.plane.flat; rest != 0; rest &= rest - 1)
        steep[left++] = first[__builtin_ctz(rest)];
    const std::uint32_t live = s.live & s.plane.flat;
    if (live == 0) return left;
    Blocks b;
    store_rows(s.part, b);
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

HWY_INLINE void draw_steep_parts(const TilePlanes& tile, const BlockPartList& list,
                                 const BlockPart* first, int count, I32x8& drawn) {
    SetUpParts s;
    set_up_parts(tile, list, first, count, s);
    Blocks b;
    store_rows(s.part, b);
    draw_steep_samples(tile, s.part, s.edges, s.plane.share, s.live, b, drawn);
}

bool draw_all_parts(const TilePlanes& tile, const BlockPartList& list) {
    I32x8 drawn = 0;
    BlockPart steep[2 * kLanesX8]; // until they fill a register
    int waiting = 0;
    const auto all = static_cast<int>(list.parts.size());
    for (int begin = 0; begin < all; begin += kLanesX8) {
        const int count = all - begin < kLanesX8 ? all - begin : kLanesX8;
        waiting +=
            draw_near_to_flat(tile, list, list.parts.data() + begin, count, drawn, steep + waiting);
        if (waiting < kLanesX8) continue;
        draw_steep_parts(tile, list, steep, kLanesX8, drawn);
        waiting -= kLanesX8;
        for (int i = 0; i < waiting; ++i)
            steep[i] = steep[kLanesX8 + i];
    }
    if (waiting > 0) draw_steep_parts(tile, list, steep, waiting, drawn);
    return any(!(drawn == I32x8(0)));
}

template <int kTileBits>
HWY_INLINE void place_lanes(const BlockGrid& grid, const std::uint32_t* triangle,
                            std::int32_t* tile, std::uint32_t* where) {
    I32 name, from, to;
    load_interleaved(triangle, name, from, to);
    const I32 half = 0xffff, one = 1, in_block = BlockGrid::kSide - 1;
    const I32 x0 = from & half, y0 = shift_right<16>(from) & I32(0x7fff);
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

} // namespace scanout::raster
#endif
