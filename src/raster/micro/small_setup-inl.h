// Set-up of binned small triangles, a register of them at a time. Included once for every SIMD
// target.
#if defined(SCANOUT_RASTER_MICRO_SMALL_SETUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_MICRO_SMALL_SETUP_INL_H
#undef SCANOUT_RASTER_MICRO_SMALL_SETUP_INL_H
#else
#define SCANOUT_RASTER_MICRO_SMALL_SETUP_INL_H
#endif

#include "raster/micro/small_triangles.h"

#include "raster/coverage/triangle_setup-inl.h"

SIMD_BEGIN(scanout::raster)

// Registers have any width: rows take eight triangles at a time, micro-triangles as many as fill a
// register.

// A vertex relative to the corner of the first block: x + 2^16 y, both below 2^14, and its depth.
template <class D>
struct BlockVertex {
    Int<D> packed_xy;
    Double<D> depth;
};

template <class D>
SIMD_INLINE void sort_two(BlockVertex<D>& a, BlockVertex<D>& b) {
    const auto swap = to_f64(b.packed_xy < a.packed_xy);
    const Int<D> first = minimum(a.packed_xy, b.packed_xy);
    b.packed_xy = maximum(a.packed_xy, b.packed_xy);
    a.packed_xy = first;
    exchange(swap, a.depth, b.depth);
}

// A register of binned triangles, in pixels of the tile.
template <class D>
struct SmallLanes {
    Int<D> x0, y0, x1, y1; // pixels that may hold samples
    Int<D> left, top;      // of the first block
    BlockVertex<D> vertex[3];
    std::uint32_t id[Int<D>::kLanes];
};

// The vertex indices of a register of triangles.
template <class D>
struct VertexIndices {
    std::uint32_t at[3][Int<D>::kLanes];
};
// Binned triangles lie far apart in memory. Prefetches the vertices of one register of them before
// its set-up, and the indices and ids of the register two further on.
template <class D>
SIMD_INLINE void read_vertices(const BinnedList& list, int first, VertexIndices<D>& out) {
    constexpr int kWidth = static_cast<int>(Int<D>::kLanes);
    const BinnedTriangle* const triangles = list.triangles.data();
    const std::uint32_t* const index = list.index.data();
    const ScreenVertex* const vertices = list.vertices.data();
    const std::uint32_t* const id = list.id.data(); // null: the spatial index is the id
    const auto last = static_cast<int>(list.triangles.size()) - 1;
    const auto read = [&](const auto& number) SIMD_LAMBDA {
        for (int i = 0; i < kWidth; ++i) {
            const std::uint32_t* vertex =
                index + std::size_t{triangles[number(first + i)].spatial_index} * 3;
            SIMD_FOR (int k = 0; k < 3; ++k) {
                out.at[k][i] = vertex[k];
                __builtin_prefetch(vertices + vertex[k]);
            }
            const int later = number(first + i + 2 * kWidth);
            __builtin_prefetch(index + std::size_t{triangles[later].spatial_index} * 3);
            if (id != nullptr) __builtin_prefetch(id + triangles[later].spatial_index);
        }
    };
    if (first + 3 * kWidth <= last)
        read([](int i) SIMD_LAMBDA { return i; });
    else if (first <= last) // the last also fills missing lanes
        read([&](int i) SIMD_LAMBDA { return i < last ? i : last; });
}

// A register of binned triangles; the last one also fills the lanes that are left.
template <class D>
struct BinnedLanes {
    Int<D> spatial_index, where;
};
template <class D>
SIMD_INLINE BinnedLanes<D> load_binned(const BinnedTriangle* binned, int count) {
    static_assert(sizeof(BinnedTriangle) == 8);
    if (count == static_cast<int>(Int<D>::kLanes)) {
        BinnedLanes<D> full;
        load_interleaved(&binned->spatial_index, full.spatial_index, full.where);
        return full;
    }
    const Int<D> at = shift_left<1>(minimum(iota<Int<D>>(0), Int<D>(count - 1)));
    const auto* stored = reinterpret_cast<const std::int32_t*>(binned);
    return {gather(stored, at), gather(stored + 1, at)};
}

template <class D>
SIMD_INLINE void load_small(const TilePlanes& tile, const BinnedList& list,
                            const BinnedTriangle* binned, int count, const VertexIndices<D>& vertex,
                            SmallLanes<D>& out) {
    using P = BinnedTriangle;
    using N = Int<D>;
    const auto s = load_binned<D>(binned, count);
    store(s.spatial_index, out.id);
    if (!list.id.empty()) {
        const std::uint32_t* const id = list.id.data();
        for (std::uint32_t& primitive : out.id)
            primitive = id[primitive];
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
        const auto v = screen_lanes<D>(list.vertices.data(), vertex.at[k]);
        out.vertex[k].packed_xy = shift_left<16>(v.y - corner_y) + (v.x - corner_x);
        out.vertex[k].depth = v.last;
    }
}

// Edge functions a x + b y + c, positive inside, from the corner of the first block on; below 2^28.
// bias: the top-left rule.
template <class D>
struct SmallEdges {
    Int<D> a[3], b[3], c[3], bias[3];
    Int<D> area; // twice the triangle's
};

template <class D>
SIMD_INLINE SmallEdges<D> edges_of(const SmallLanes<D>& lanes) {
    using N = Int<D>;
    const N zero = 0;
    N x[3], y[3];
    SIMD_FOR (int k = 0; k < 3; ++k) {
        const N packed_xy = lanes.vertex[k].packed_xy;
        y[k] = shift_right<16>(packed_xy + N(1 << 15));
        x[k] = packed_xy - shift_left<16>(y[k]);
    }
    const N twice_area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
    const Mask<D> reversed = twice_area < zero;
    SmallEdges<D> e;
    e.area = select(reversed, zero - twice_area, twice_area);
    SIMD_FOR (int k = 0; k < 3; ++k) {
        const int from = k == 2 ? 0 : k + 1, to = k == 0 ? 2 : k - 1;
        const N a = y[from] - y[to], b = x[to] - x[from];
        e.a[k] = select(reversed, zero - a, a);
        e.b[k] = select(reversed, zero - b, b);
        e.c[k] = zero - (e.a[k] * x[from] + e.b[k] * y[from]);
        e.bias[k] = select(is_top_left(e.a[k], e.b[k]), zero, N(-1));
    }
    return e;
}

// At the corner of a pixel. column, row: from the first block's corner.
template <class D>
SIMD_INLINE void edges_at_pixel(const SmallEdges<D>& e, Int<D> column, Int<D> row,
                                Int<D> (&out)[3]) {
    SIMD_FOR (int k = 0; k < 3; ++k)
        out[k] = e.c[k] + shift_left<kSubpixelBits>(e.a[k] * column + e.b[k] * row);
}

template <class D>
SIMD_INLINE Double<D> depth_of(const Int<D> (&edge)[3], const Double<D> (&depth_factor)[3]) {
    const Double<D> exact[3] = {to_f64(edge[0]), to_f64(edge[1]), to_f64(edge[2])};
    return depth_of(exact, depth_factor);
}

// Edge functions at the samples of one pattern index, biased: negative is outside. corner: the edge
// functions at the corner of the first pixel.
template <class D>
SIMD_INLINE void edges_at(const SmallEdges<D>& e, const Int<D> (&corner)[3], SampleOffset at,
                          Int<D> (&out)[3]) {
    SIMD_FOR (int k = 0; k < 3; ++k)
        out[k] = (corner[k] + e.bias[k]) + (e.a[k] * Int<D>(at.x) + e.b[k] * Int<D>(at.y));
}

// The set-up that all kinds share, a register of triangles.
template <class D>
struct SmallSetup {
    SmallLanes<D> lanes;
    SmallEdges<D> edges;
    DepthPlane<D> plane;
    std::uint32_t live; // has an area
};
template <class D>
SIMD_INLINE void set_up_small(const TilePlanes& tile, const BinnedList& list,
                              const BinnedTriangle* first, int count,
                              const VertexIndices<D>& vertex, SmallSetup<D>& s) {
    load_small(tile, list, first, count, vertex, s.lanes);
    sort_canonically(s.lanes.vertex);
    s.edges = edges_of(s.lanes);
    Double<D> a[3], b[3];
    SIMD_FOR (int k = 0; k < 3; ++k) {
        a[k] = to_f64(s.edges.a[k]);
        b[k] = to_f64(s.edges.b[k]);
    }
    const BlockVertex<D>(&v)[3] = s.lanes.vertex;
    // All edge steps together are at most 2^14 (kSmallSide). Depths across a float-depth plane
    // differ by a sixteenth at most, or by the rounding of sums. So above this area the terms are
    // less than 2^9 times the least depth, as depth_plane needs.
    constexpr std::int32_t kPlain = 1 << 6;
    const bool cancels = any(s.edges.area < Int<D>(kPlain));
    const Double<D> depth[3] = {v[0].depth, v[1].depth, v[2].depth};
    s.plane = depth_plane(depth, a, b, to_f64(maximum(s.edges.area, Int<D>(1))), cancels);
    s.live = bits(s.edges.area > Int<D>(0)) & ((2U << (count - 1)) - 1);
}

SIMD_END

#endif
