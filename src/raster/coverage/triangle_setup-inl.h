// Triangle set-up as a structure of arrays, the input of block traversal. Included once for every
// SIMD target.
#if defined(SCANOUT_RASTER_COVERAGE_TRIANGLE_SETUP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_COVERAGE_TRIANGLE_SETUP_INL_H
#undef SCANOUT_RASTER_COVERAGE_TRIANGLE_SETUP_INL_H
#else
#define SCANOUT_RASTER_COVERAGE_TRIANGLE_SETUP_INL_H
#endif

#include "raster/coverage/block_traversal.h"

#include "raster/coverage/triangle-inl.h"

SIMD_BEGIN(scanout::raster)

// Several triangles side by side (SoA).
struct TriangleSetup {
    static constexpr int kTriangles = 8;
    std::uint32_t vertex[3][kTriangles]; // indices
    std::uint32_t id[kTriangles];
    // Edge functions a x + b y + c, positive inside, opposite vertex i; whole numbers and exact,
    // |E| < 2^50. bias: 0 or -1, the top-left rule: inside iff E + bias >= 0.
    double a[3][kTriangles], b[3][kTriangles], c[3][kTriangles], bias[3][kTriangles];
    // Bounds of the difference between E + bias in a block and E at the block's corner.
    double lowest[3][kTriangles], highest[3][kTriangles];
    double depth_factor[3][kTriangles], per_x[kTriangles], per_y[kTriangles]; // DepthPlane
    double nearest[kTriangles]; // depth of the nearest vertex
    // The pixels of the tile that it may touch.
    std::int32_t x0[kTriangles], y0[kTriangles], x1[kTriangles], y1[kTriangles];
    // Bit i: triangle i. small: it touches four blocks at most.
    std::uint32_t live, float_depth, small;
};

struct LaneVertex {
    F64x8 key, x, y, depth;
};

SIMD_INLINE void sort_two(LaneVertex& a, LaneVertex& b) {
    const auto swap = b.key < a.key;
    exchange(swap, a.key, b.key);
    exchange(swap, a.x, b.x);
    exchange(swap, a.y, b.y);
    exchange(swap, a.depth, b.depth);
}

SIMD_INLINE void set_up_bounds(const LaneVertex (&v)[3], const TilePlanes& tile,
                               const SampleExtent& extent, TriangleSetup& w, int i) {
    // The first and the last pixel whose samples, between low and high, may lie in [min, max].
    const auto first = [](F64x8 least, std::int32_t high) SIMD_LAMBDA {
        return shift_right<kSubpixelBits>(to_i32(least) + I32x8(kSubpixel - 1 - high));
    };
    const auto end = [](F64x8 most, std::int32_t low) SIMD_LAMBDA {
        return shift_right<kSubpixelBits>(to_i32(most) + I32x8(kSubpixel - low));
    };
    const F64x8 min_x = minimum(minimum(v[0].x, v[1].x), v[2].x);
    const F64x8 max_x = maximum(maximum(v[0].x, v[1].x), v[2].x);
    const auto& area = tile.area;
    store(maximum(first(min_x, extent.high.x) - I32x8(area.x0), 0), w.x0 + i);
    store(maximum(first(v[0].y, extent.high.y) - I32x8(area.y0), 0), w.y0 + i);
    store(minimum(end(max_x, extent.low.x), area.x1) - I32x8(area.x0), w.x1 + i);
    store(minimum(end(v[2].y, extent.low.y), area.y1) - I32x8(area.y0), w.y1 + i);
}

// Depth from the edge functions' values, or its step from their steps. depth_factor: a vertex's
// depth divided by twice the area.
template <class D>
SIMD_INLINE Double<D> depth_of(const Double<D> (&edge)[3], const Double<D> (&depth_factor)[3]) {
    return (edge[0] * depth_factor[0] + edge[1] * depth_factor[1]) + edge[2] * depth_factor[2];
}

// The plane of depth over the screen, and which of the lanes have float depth
// (raster/coverage/coverage.h).
template <class D>
struct DepthPlane {
    Double<D> depth_factor[3]; // as depth_of takes them
    Double<D> per_x, per_y;
    std::uint32_t float_depth;
};
// a, b: steps of the edge functions; area: twice the triangle's. cancels: false where cancellation
// in the sums below is known to be harmless; if true, it is tested.
template <class D>
SIMD_INLINE DepthPlane<D> depth_plane(const Double<D> (&depth)[3], const Double<D> (&a)[3],
                                      const Double<D> (&b)[3], Double<D> area,
                                      bool cancels = true) {
    using Wide = Double<D>;
    DepthPlane<D> plane;
    const Wide inverse = Wide(1.0) / area; // one division: the slowest operation here
    SIMD_FOR (int k = 0; k < 3; ++k)
        plane.depth_factor[k] = depth[k] * inverse;
    plane.per_x = depth_of(a, plane.depth_factor) * Wide(kSubpixel);
    plane.per_y = depth_of(b, plane.depth_factor) * Wide(kSubpixel);
    const Wide least = minimum(minimum(depth[0], depth[1]), depth[2]);
    constexpr double kBlock = PixelBlock::kSide;
    auto float_depth =
        (least >= Wide(0x1p-100)) &
        (Wide(kBlock) * (abs(plane.per_x) + abs(plane.per_y)) <= least * Wide(1 / 32.0));
    if (cancels) {
        Wide terms = 0.0; // of the sums, across a block
        SIMD_FOR (int k = 0; k < 3; ++k)
            terms = terms + (abs(a[k]) + abs(b[k])) * plane.depth_factor[k];
        float_depth = float_depth & (Wide(kBlock * kSubpixel) * terms <= least * Wide(0x1p20));
    }
    plane.float_depth = bits(float_depth);
    return plane;
}

SIMD_INLINE void set_up_edges(const F64x8 (&a)[3], const F64x8 (&b)[3], const LaneVertex (&v)[3],
                              const SampleExtent& extent, TriangleSetup& w, int i) {
    constexpr double kAcross = (PixelBlock::kSide - 1) * kSubpixel;
    const F64x8 left = static_cast<double>(extent.low.x), top = static_cast<double>(extent.low.y);
    const F64x8 right = kAcross + extent.high.x, bottom = kAcross + extent.high.y;
    const F64x8 zero = 0.0;
    SIMD_FOR (int k = 0; k < 3; ++k) {
        const int from = k == 2 ? 0 : k + 1;
        const F64x8 bias = select(is_top_left(a[k], b[k]), zero, F64x8(-1.0));
        const auto leans_left = a[k] < zero, leans_up = b[k] < zero;
        store(a[k], w.a[k] + i);
        store(b[k], w.b[k] + i);
        store(-(a[k] * v[from].x + b[k] * v[from].y), w.c[k] + i);
        store(bias, w.bias[k] + i);
        store((bias + a[k] * select(leans_left, right, left)) +
                  b[k] * select(leans_up, bottom, top),
              w.lowest[k] + i);
        store((bias + a[k] * select(leans_left, left, right)) +
                  b[k] * select(leans_up, top, bottom),
              w.highest[k] + i);
    }
}

// Loads at most kTriangles triangles, from number `begin` of the list on; the last one also fills
// the lanes that are left.
SIMD_INLINE void load_vertices(const TriangleList& list, int begin, int count, TriangleSetup& w) {
    for (int i = 0; i < TriangleSetup::kTriangles; ++i) {
        const int at = begin + (i < count ? i : count - 1);
        const std::uint32_t* index = list.index.data() + std::size_t{list.which.data()[at]} * 3;
        w.id[i] = list.id.data()[at];
        SIMD_FOR (int k = 0; k < 3; ++k)
            w.vertex[k][i] = index[k];
    }
}

SIMD_INLINE LaneVertex vertex_of(const ScreenVertex* vertices, const std::uint32_t* index) {
    const auto v = vertices_at<F32x8>(vertices, index);
    LaneVertex c;
    c.x = to_f64(v.word(0));
    c.y = to_f64(v.word(1));
    c.depth = v.last_double();
    c.key = c.y * F64x8(0x1p26) + c.x; // |x| < 2^25
    return c;
}

// All operations on coordinates are exact; only the plane of depth is rounded. count: live lanes.
SIMD_INLINE void set_up(const TilePlanes& tile, const SampleExtent& extent,
                        const ScreenVertex* vertices, int count, TriangleSetup& w) {
    w.live = w.float_depth = w.small = 0;
    for (int i = 0; i < TriangleSetup::kTriangles; i += kLanesX8) {
        LaneVertex v[3];
        SIMD_FOR (int k = 0; k < 3; ++k)
            v[k] = vertex_of(vertices, w.vertex[k] + i);
        sort_canonically(v);
        const F64x8 twice_area =
            (v[1].x - v[0].x) * (v[2].y - v[0].y) - (v[1].y - v[0].y) * (v[2].x - v[0].x);
        const F64x8 sign = select(twice_area < F64x8(0.0), F64x8(-1.0), F64x8(1.0));
        const auto some = abs(twice_area) > F64x8(0.0); // a triangle without area covers no sample
        const F64x8 area = select(some, abs(twice_area), F64x8(1.0));
        F64x8 a[3], b[3];
        SIMD_FOR (int k = 0; k < 3; ++k) {
            const LaneVertex &from = v[k == 2 ? 0 : k + 1], &to = v[k == 0 ? 2 : k - 1];
            a[k] = sign * (from.y - to.y);
            b[k] = sign * (to.x - from.x);
        }
        set_up_edges(a, b, v, extent, w, i);
        set_up_bounds(v, tile, extent, w, i);
        const F64x8 depth[3] = {v[0].depth, v[1].depth, v[2].depth};
        const auto plane = depth_plane(depth, a, b, area);
        SIMD_FOR (int k = 0; k < 3; ++k)
            store(plane.depth_factor[k], w.depth_factor[k] + i);
        store(maximum(maximum(v[0].depth, v[1].depth), v[2].depth), w.nearest + i);
        store(plane.per_x, w.per_x + i);
        store(plane.per_y, w.per_y + i);
        w.float_depth |= plane.float_depth << i;
        const MaskX8 touches = (load<I32x8>(w.x0 + i) < load<I32x8>(w.x1 + i)) &
                               (load<I32x8>(w.y0 + i) < load<I32x8>(w.y1 + i));
        w.live |= (bits(some) & bits(touches)) << i;
        const auto blocks = [&](const std::int32_t* from, const std::int32_t* to) SIMD_LAMBDA {
            return shift_right<3>(load<I32x8>(to + i) + 7) - shift_right<3>(load<I32x8>(from + i));
        };
        w.small |= bits(blocks(w.x0, w.x1) * blocks(w.y0, w.y1) <= I32x8(4)) << i;
    }
    w.live &= (2U << (count - 1)) - 1;
}

SIMD_END

#endif
