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

// All of this is for registers of any width: strips are set up eight at a time, specks as many as a
// register holds.

// A vertex relative to the corner of the first block: x + 2^16 y, both below 2^14, and its depth.
template <class D>
struct NearCorner {
    Int<D> place;
    Double<D> depth;
};

template <class D>
SIMD_INLINE void sort_two(NearCorner<D>& a, NearCorner<D>& b) {
    const auto turn = to_f64(b.place < a.place);
    const Int<D> first = minimum(a.place, b.place);
    b.place = maximum(a.place, b.place);
    a.place = first;
    exchange(turn, a.depth, b.depth);
}

// The parts of a register, in pixels of the tile.
template <class D>
struct PartLanes {
    Int<D> x0, y0, x1, y1; // what may hold samples
    Int<D> left, top;      // of the first block
    NearCorner<D> vertex[3];
    std::uint32_t name[Int<D>::kLanes];
};

// The vertices of a register of parts.
template <class D>
struct PartCorners {
    std::uint32_t at[3][Int<D>::kLanes];
};
// Parts of a tile lie far apart in memory. So before a register of them is needed its vertices are
// asked for, and the indices and names of those that are two registers further on.
template <class D>
SIMD_INLINE void read_corners(const TilePartList& list, int first, PartCorners<D>& out) {
    constexpr int kWidth = static_cast<int>(Int<D>::kLanes);
    const TilePart* const parts = list.parts.data();
    const std::uint32_t* const index = list.index.data();
    const ScreenVertex* const vertices = list.vertices.data();
    const std::uint32_t* const id = list.id.data(); // null: parts are named by their place
    const auto last = static_cast<int>(list.parts.size()) - 1;
    const auto read = [&](const auto& number) SIMD_LAMBDA {
        for (int i = 0; i < kWidth; ++i) {
            const std::uint32_t* corner = index + std::size_t{parts[number(first + i)].place} * 3;
            SIMD_FOR (int k = 0; k < 3; ++k) {
                out.at[k][i] = corner[k];
                __builtin_prefetch(vertices + corner[k]);
            }
            const int later = number(first + i + 2 * kWidth);
            __builtin_prefetch(index + std::size_t{parts[later].place} * 3);
            if (id != nullptr) __builtin_prefetch(id + parts[later].place);
        }
    };
    if (first + 3 * kWidth <= last)
        read([](int i) SIMD_LAMBDA { return i; });
    else if (first <= last) // the last stands for what is missing
        read([&](int i) SIMD_LAMBDA { return i < last ? i : last; });
}

// A register of parts; the last stands for what is missing.
template <class D>
struct StoredParts {
    Int<D> place, where;
};
template <class D>
SIMD_INLINE StoredParts<D> stored_parts(const TilePart* part, int count) {
    static_assert(sizeof(TilePart) == 8);
    if (count == static_cast<int>(Int<D>::kLanes)) {
        StoredParts<D> full;
        load_interleaved(&part->place, full.place, full.where);
        return full;
    }
    const Int<D> at = shift_left<1>(minimum(iota<Int<D>>(0), Int<D>(count - 1)));
    const auto* stored = reinterpret_cast<const std::int32_t*>(part);
    return {gather(stored, at), gather(stored + 1, at)};
}

template <class D>
SIMD_INLINE void load_parts(const TilePlanes& tile, const TilePartList& list, const TilePart* part,
                            int count, const PartCorners<D>& corner, PartLanes<D>& out) {
    using P = TilePart;
    using N = Int<D>;
    const auto s = stored_parts<D>(part, count);
    store(s.place, out.name);
    if (!list.id.empty()) {
        const std::uint32_t* const id = list.id.data();
        for (std::uint32_t& name : out.name)
            name = id[name];
    }
    out.x0 = s.where & N(63);
    out.y0 = shift_right<P::kFirstRow>(s.where) & N(63);
    out.x1 = shift_right<P::kEndColumn>(s.where) & N(127);
    out.y1 = shift_right<P::kEndRow>(s.where);
    out.left = out.x0 & N(-8);
    out.top = out.y0 & N(-8);
    const N corner_x = shift_left<kSubpixelBits>(out.left + N(tile.area.x0));
    const N corner_y = shift_left<kSubpixelBits>(out.top + N(tile.area.y0));
    SIMD_FOR (int k = 0; k < 3; ++k) {
        const auto v = screen_lanes<D>(list.vertices.data(), corner.at[k]);
        out.vertex[k].place = shift_left<16>(v.y - corner_y) + (v.x - corner_x);
        out.vertex[k].depth = v.last;
    }
}

// Edge functions a x + b y + c, positive inside, from the corner of the first block on; below 2^28.
// bias: the top-left rule.
template <class D>
struct PartEdges {
    Int<D> a[3], b[3], c[3], bias[3];
    Int<D> area; // twice the triangle's
};

template <class D>
SIMD_INLINE PartEdges<D> edges_of(const PartLanes<D>& part) {
    using N = Int<D>;
    const N zero = 0;
    N x[3], y[3];
    SIMD_FOR (int k = 0; k < 3; ++k) {
        const N place = part.vertex[k].place;
        y[k] = shift_right<16>(place + N(1 << 15));
        x[k] = place - shift_left<16>(y[k]);
    }
    const N twice = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
    const Mask<D> turned = twice < zero;
    PartEdges<D> e;
    e.area = select(turned, zero - twice, twice);
    SIMD_FOR (int k = 0; k < 3; ++k) {
        const int from = k == 2 ? 0 : k + 1, to = k == 0 ? 2 : k - 1;
        const N a = y[from] - y[to], b = x[to] - x[from];
        e.a[k] = select(turned, zero - a, a);
        e.b[k] = select(turned, zero - b, b);
        e.c[k] = zero - (e.a[k] * x[from] + e.b[k] * y[from]);
        e.bias[k] = select(is_top_left(e.a[k], e.b[k]), zero, N(-1));
    }
    return e;
}

// At the corner of a pixel. column, row: from the first block's corner.
template <class D>
SIMD_INLINE void edges_at_pixel(const PartEdges<D>& e, Int<D> column, Int<D> row,
                                Int<D> (&out)[3]) {
    SIMD_FOR (int k = 0; k < 3; ++k)
        out[k] = e.c[k] + shift_left<kSubpixelBits>(e.a[k] * column + e.b[k] * row);
}

template <class D>
SIMD_INLINE Double<D> depth_of(const Int<D> (&edge)[3], const Double<D> (&share)[3]) {
    const Double<D> exact[3] = {to_f64(edge[0]), to_f64(edge[1]), to_f64(edge[2])};
    return depth_of(exact, share);
}

// At the samples of one place in the pattern, so that the sign tells which side they lie on.
// corner: the edges at the corner of the first pixel.
template <class D>
SIMD_INLINE void edges_at(const PartEdges<D>& e, const Int<D> (&corner)[3], SampleOffset at,
                          Int<D> (&out)[3]) {
    SIMD_FOR (int k = 0; k < 3; ++k)
        out[k] = (corner[k] + e.bias[k]) + (e.a[k] * Int<D>(at.x) + e.b[k] * Int<D>(at.y));
}

// A register of parts with what all kinds need.
template <class D>
struct SetUpParts {
    PartLanes<D> part;
    PartEdges<D> edges;
    DepthPlane<D> plane;
    std::uint32_t live; // has an area
};
template <class D>
SIMD_INLINE void set_up_parts(const TilePlanes& tile, const TilePartList& list,
                              const TilePart* first, int count, const PartCorners<D>& corner,
                              SetUpParts<D>& s) {
    load_parts(tile, list, first, count, corner, s.part);
    put_in_order(s.part.vertex);
    s.edges = edges_of(s.part);
    Double<D> a[3], b[3];
    SIMD_FOR (int k = 0; k < 3; ++k) {
        a[k] = to_f64(s.edges.a[k]);
        b[k] = to_f64(s.edges.b[k]);
    }
    const NearCorner<D>(&v)[3] = s.part.vertex;
    // All steps together are at most 2^14 (kSmallSide). Depths over which a flat plane goes differ
    // by a sixteenth, or by the rounding of sums; so from this area on terms are less than 2^9
    // times the least depth, which is what depth_plane asks.
    constexpr std::int32_t kPlain = 1 << 6;
    const bool cancels = any(s.edges.area < Int<D>(kPlain));
    const Double<D> depth[3] = {v[0].depth, v[1].depth, v[2].depth};
    s.plane = depth_plane(depth, a, b, to_f64(maximum(s.edges.area, Int<D>(1))), cancels);
    s.live = bits(s.edges.area > Int<D>(0)) & ((2U << (count - 1)) - 1);
}

SIMD_END

#endif
