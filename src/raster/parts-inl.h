// Set-up of the parts that a tile has of small triangles, a register of them at a time. Included
// once for every SIMD target.
#if defined(SCANOUT_RASTER_PARTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_PARTS_INL_H
#undef SCANOUT_RASTER_PARTS_INL_H
#else
#define SCANOUT_RASTER_PARTS_INL_H
#endif

#include "raster/small_triangles.h"

#include "raster/walks-inl.h"

SIMD_BEGIN(scanout::raster)

// A vertex relative to the corner of the first block: x + 2^16 y, both below 2^14, and its depth.
struct NearCorner {
    F64x8 place, depth;
};

HWY_INLINE void sort_two(NearCorner& a, NearCorner& b) {
    const auto turn = b.place < a.place;
    exchange(turn, a.place, b.place);
    exchange(turn, a.depth, b.depth);
}

// The parts of a register, in pixels of the tile.
struct PartLanes {
    I32x8 x0, y0, x1, y1; // what may hold samples
    I32x8 left, top;      // of the first block
    NearCorner vertex[3];
    std::uint32_t name[kLanesX8];
};

// The vertices of a register of parts.
struct PartCorners {
    std::uint32_t at[3][kLanesX8];
};
// Parts of a tile lie far apart in memory. So before a register of them is needed its vertices are
// asked for, and the indices of those that are two registers further on.
HWY_INLINE void read_corners(const TilePartList& list, int first, PartCorners& out) {
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
HWY_INLINE StoredParts stored_parts(const TilePart* part, int count) {
    static_assert(sizeof(TilePart) == 8);
    const I32x8 at = shift_left<1>(minimum(iota<I32x8>(0), I32x8(count - 1)));
    const auto* stored = reinterpret_cast<const std::int32_t*>(part);
    return {gather(stored, at), gather(stored + 1, at)};
}

HWY_INLINE void load_parts(const TilePlanes& tile, const TilePartList& list, const TilePart* part,
                           int count, const PartCorners& corner, PartLanes& out) {
    using P = TilePart;
    const StoredParts s = stored_parts(part, count);
    store(s.triangle, out.name);
    out.x0 = s.where & I32x8(63);
    out.y0 = shift_right<P::kFirstRow>(s.where) & I32x8(63);
    out.x1 = shift_right<P::kEndColumn>(s.where) & I32x8(127);
    out.y1 = shift_right<P::kEndRow>(s.where);
    out.left = out.x0 & I32x8(-8);
    out.top = out.y0 & I32x8(-8);
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

// Edge functions a x + b y + c, positive inside, from the corner of the first block on; below 2^28.
// bias: the top-left rule.
struct PartEdges {
    I32x8 a[3], b[3], c[3], bias[3];
    I32x8 area; // twice the triangle's
};

// The top-left rule.
HWY_INLINE I32x8 bias_of(I32x8 a, I32x8 b) {
    return select(is_top_left(a, b), I32x8(0), I32x8(-1));
}

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
        e.bias[k] = bias_of(e.a[k], e.b[k]);
    }
    return e;
}

// At the corner of a pixel. column, row: from the first block's corner.
HWY_INLINE void edges_at_pixel(const PartEdges& e, I32x8 column, I32x8 row, I32x8 (&out)[3]) {
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        out[k] = e.c[k] + shift_left<kSubpixelBits>(e.a[k] * column + e.b[k] * row);
}

HWY_INLINE F64x8 depth_of(const I32x8 (&edge)[3], const F64x8 (&share)[3]) {
    const F64x8 exact[3] = {to_f64(edge[0]), to_f64(edge[1]), to_f64(edge[2])};
    return depth_of(exact, share);
}

// At the samples of one place in the pattern, so that the sign tells which side they lie on.
// corner: the edges at the corner of the first pixel.
HWY_INLINE void edges_at(const PartEdges& e, const I32x8 (&corner)[3], SampleOffset at,
                         I32x8 (&out)[3]) {
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k)
        out[k] = (corner[k] + e.bias[k]) + (e.a[k] * I32x8(at.x) + e.b[k] * I32x8(at.y));
}

// A register of parts with what all kinds need.
struct SetUpParts {
    PartLanes part;
    PartEdges edges;
    DepthPlane plane;
    std::uint32_t live; // has an area
};
HWY_INLINE void set_up_parts(const TilePlanes& tile, const TilePartList& list,
                             const TilePart* first, int count, const PartCorners& corner,
                             SetUpParts& s) {
    load_parts(tile, list, first, count, corner, s.part);
    put_in_order(s.part.vertex);
    s.edges = edges_of(s.part);
    F64x8 a[3], b[3];
    SIMD_UNROLL
    for (int k = 0; k < 3; ++k) {
        a[k] = to_f64(s.edges.a[k]);
        b[k] = to_f64(s.edges.b[k]);
    }
    const NearCorner(&v)[3] = s.part.vertex;
    // All steps together are at most 2^14 (kSmallSide). Depths over which a flat plane goes differ by
    // a sixteenth, or by the rounding of sums; so from this area on terms are less than 2^9 times the
    // least depth, which is what depth_plane asks.
    constexpr std::int32_t kPlain = 1 << 6;
    const bool cancels = any(s.edges.area < I32x8(kPlain));
    s.plane = depth_plane({v[0].depth, v[1].depth, v[2].depth}, a, b,
                          to_f64(maximum(s.edges.area, 1)), cancels);
    s.live = bits(s.edges.area > I32x8(0)) & ((2U << (count - 1)) - 1);
}

SIMD_END

#endif
