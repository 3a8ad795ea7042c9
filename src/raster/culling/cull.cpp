#include "raster/culling/cull.h"

#include "raster/micro/small_triangles.h"

#define SIMD_FILE "raster/culling/cull.cpp"
#include "simd/for_each_target.h"

#include "raster/coverage/triangle-inl.h"

SIMD_BEGIN(scanout::raster)

using Mask32 = Mask<F32::Tag>;

// First and last + 1 pixel whose samples, between low and high, may lie in [min, max].
SIMD_INLINE I32 first_pixel(I32 min, std::int32_t high) {
    return shift_right<kSubpixelBits>(min + I32(kSubpixel - 1 - high));
}
SIMD_INLINE I32 end_pixel(I32 max, std::int32_t low) {
    return shift_right<kSubpixelBits>(max + I32(kSubpixel - low));
}

struct TriangleVertices {
    I32 x[3], y[3];
};

SIMD_INLINE TriangleVertices vertices_of(const ScreenVertex* vertices, const std::uint32_t* index) {
    TriangleVertices c;
    SIMD_FOR (int k = 0; k < 3; ++k) {
        const auto v = vertices_at<F32>(vertices, index + k, 3);
        c.x[k] = v.word(0);
        c.y[k] = v.word(1);
    }
    return c;
}

// Triangles at most this many pixels wide and high are tested at every sample: half of those near
// the size of a pixel cover none, and need not be binned. Their samples lie in one pixel more, each
// way, at most.
constexpr int kTiny = 3;

// The pixels that a triangle may touch: from (x0, y0) on, `across` by `down` of them.
struct Box {
    I32 x0, y0, across, down;
};

// Does the triangle, tiny and not without area, cover no sample of its box? No lane's box is larger
// than kSide each way. The box cuts the triangle only at the picture's edge: only lanes that lie
// there (at_edge: some do) test samples for being outside the box, so that no lane's result depends
// on its neighbours. Edge functions as in raster/screen/primitive.h, integers below 2^23.
template <int kSide>
SIMD_INLINE Mask32 misses_all(std::span<const SampleOffset> pattern, const TriangleVertices& c,
                              Mask32 negative, const Box& box, bool at_edge) {
    const I32 x[3] = {c.x[0], select(negative, c.x[2], c.x[1]), select(negative, c.x[1], c.x[2])};
    const I32 y[3] = {c.y[0], select(negative, c.y[2], c.y[1]), select(negative, c.y[1], c.y[2])};
    const I32 left = shift_left<kSubpixelBits>(box.x0), top = shift_left<kSubpixelBits>(box.y0);
    I32 first[3], a[3], b[3]; // at the first pixel's corner, and a step of a pixel
    SIMD_FOR (int k = 0; k < 3; ++k) {
        const int to = k == 2 ? 0 : k + 1;
        const I32 per_x = y[k] - y[to], per_y = x[to] - x[k];
        first[k] = select(is_top_left(per_x, per_y), I32(0), I32(-1)) + per_x * (left - x[k]) +
                   per_y * (top - y[k]);
        a[k] = per_x;
        b[k] = per_y;
    }
    I32 outside = -1; // sign bit: at every sample so far some edge is negative
    for (const SampleOffset* at = pattern.data(); at != pattern.data() + pattern.size(); ++at) {
        I32 row[3], step[3], down_step[3];
        SIMD_FOR (int k = 0; k < 3; ++k) {
            row[k] = first[k] + a[k] * I32(at->x) + b[k] * I32(at->y);
            step[k] = shift_left<kSubpixelBits>(a[k]);
            down_step[k] = shift_left<kSubpixelBits>(b[k]);
        }
        SIMD_FOR (int j = 0; j < kSide; ++j) {
            I32 e[3] = {row[0], row[1], row[2]};
            SIMD_FOR (int i = 0; i < kSide; ++i) {
                I32 misses = e[0] | e[1] | e[2];
                if (at_edge) misses = misses | (box.across - I32(i + 1)) | (box.down - I32(j + 1));
                outside = outside & misses;
                SIMD_FOR (int k = 0; k < 3; ++k)
                    e[k] = e[k] + step[k];
            }
            SIMD_FOR (int k = 0; k < 3; ++k)
                row[k] = row[k] + down_step[k];
        }
    }
    return outside < I32(0);
}
SIMD_INLINE Mask32 misses_all(std::span<const SampleOffset> pattern, const TriangleVertices& c,
                              Mask32 tiny, Mask32 negative, const Box& box, bool at_edge) {
    static_assert(kTiny == 3);
    const I32 side = maximum(box.across, box.down);
    if (!any(tiny & (side > I32(2)))) return misses_all<2>(pattern, c, negative, box, at_edge);
    if (!any(tiny & (side > I32(3)))) return misses_all<3>(pattern, c, negative, box, at_edge);
    return misses_all<4>(pattern, c, negative, box, at_edge);
}

// Twice the area's sign, y down. extent: the longer side of the box.
SIMD_INLINE I32 winding_of(const TriangleVertices& c, I32 extent) {
    const I32 dx1 = c.x[1] - c.x[0], dy1 = c.y[1] - c.y[0];
    const I32 dx2 = c.x[2] - c.x[0], dy2 = c.y[2] - c.y[0];
    constexpr std::int32_t kNarrow = 1 << 14; // products of 28 bits
    if (!any(extent > I32(kNarrow))) return dx1 * dy2 - dy1 * dx2;
    // Exact in double: |dx|, |dy| <= 2^24. A float keeps its sign and its zero.
    const F32 area = to_f32(to_f64(dx1) * to_f64(dy2) - to_f64(dy1) * to_f64(dx2));
    const F32 zero = 0.0F;
    return select(area > zero, I32(1), select(area < zero, I32(-1), I32(0)));
}

// Results of several registers of triangles, before any is appended to the lists. How many of a
// register are visible is known late; a mispredicted branch on it would discard what the processor
// has begun of the next register.
struct FoundLanes {
    static constexpr int kRegisters = 16;
    std::uint32_t from[kRegisters * kLanes], to[kRegisters * kLanes]; // of VisibleTriangle
    std::uint32_t visible[kRegisters], to_clip[kRegisters];           // a bit a lane
};

// live: how many of the lanes are triangles; r: the register.
SIMD_INLINE void cull_lanes(const CullOptions& o, const TriangleVertices& c, int live, int r,
                            FoundLanes& found) {
    const I32 off = ScreenVertex::kOffScreen;
    const Mask32 off0 = c.x[0] == off, off1 = c.x[1] == off, off2 = c.x[2] == off;
    const Mask32 any_off = off0 | off1 | off2;

    const I32 min_x = minimum(minimum(c.x[0], c.x[1]), c.x[2]);
    const I32 max_x = maximum(maximum(c.x[0], c.x[1]), c.x[2]);
    const I32 min_y = minimum(minimum(c.y[0], c.y[1]), c.y[2]);
    const I32 max_y = maximum(maximum(c.y[0], c.y[1]), c.y[2]);
    // Off the screen it may be any number.
    const I32 extent = maximum(max_x - min_x, max_y - min_y), winding = winding_of(c, extent);
    // Counter-clockwise is front, unless the view mirrors. Area 0 covers nothing (HARD-CASES 4).
    const bool both = o.keep == Facing::any, clockwise = (o.keep == Facing::front) == o.mirrored;
    Mask32 visible = !any_off;
    if (both || clockwise)
        visible = both ? visible & !(winding == I32(0)) : visible & (winding > I32(0));
    if (!both && !clockwise) visible = visible & (winding < I32(0));

    const I32 x0 = maximum(first_pixel(min_x, o.extent.high.x), 0);
    const I32 y0 = maximum(first_pixel(min_y, o.extent.high.y), 0);
    const I32 x1 = minimum(end_pixel(max_x, o.extent.low.x), o.width);
    const I32 y1 = minimum(end_pixel(max_y, o.extent.low.y), o.height);
    visible = visible & (x0 < x1) & (y0 < y1);
    const Mask32 tiny = visible & (extent <= I32(kTiny * kSubpixel));
    if (!o.pattern.empty() && any(tiny)) {
        const bool at_edge = any(tiny & ((x1 == o.width) | (y1 == o.height)));
        visible = visible & !(tiny & misses_all(o.pattern, c, tiny, winding < I32(0),
                                                {x0, y0, x1 - x0, y1 - y0}, at_edge));
    }

    // All vertices off the screen at one side, or one that is not finite: culled without clipping.
    const I32 all_flags =
        select(off0, c.y[0], 0) & select(off1, c.y[1], 0) & select(off2, c.y[2], 0);
    const I32 any_flags =
        select(off0, c.y[0], 0) | select(off1, c.y[1], 0) | select(off2, c.y[2], 0);
    const Mask32 inside = (all_flags & I32(kOutsideMask)) == I32(0);
    const Mask32 finite = (any_flags & I32(kNotFinite)) == I32(0);
    const Mask32 to_clip = any_off & (inside & finite);

    const std::uint32_t lanes = (2U << (live - 1)) - 1;
    const Mask32 small = extent <= I32(kSmallSide * kSubpixel);
    const Mask32 back_facing = o.mirrored ? winding < I32(0) : winding > I32(0);
    const I32 back = both ? select(back_facing, I32(VisibleTriangle::kBackFacing), I32(0)) : I32(0);
    store(select(small, I32(INT32_MIN), I32(0)) | shift_left<16>(y0) | x0 | back,
          found.from + std::ptrdiff_t{r} * kLanes);
    store(shift_left<16>(y1) | x1, found.to + std::ptrdiff_t{r} * kLanes);
    found.visible[r] = bits(visible) & lanes;
    found.to_clip[r] = bits(to_clip) & lanes;
}

SIMD_INLINE void list(const FoundLanes& found, int registers, std::uint32_t first,
                      CullResult& result) {
    VisibleTriangle* visible = result.visible.data() + result.visible_count;
    for (int r = 0; r < registers; ++r) {
        const auto at = static_cast<std::uint32_t>(r * kLanes);
        if constexpr (kPacksLanes) {
            const I32 spatial_index = iota<I32>(static_cast<std::int32_t>(first + at));
            visible += store_packed(found.visible[r], spatial_index, load<I32>(found.from + at),
                                    load<I32>(found.to + at), &visible->spatial_index);
        } else {
            for (std::uint32_t rest = found.visible[r]; rest != 0; rest &= rest - 1) {
                const std::uint32_t i = at + static_cast<std::uint32_t>(__builtin_ctz(rest));
                *visible++ = {first + i, found.from[i], found.to[i]};
            }
        }
        for (std::uint32_t rest = found.to_clip[r]; rest != 0; rest &= rest - 1)
            result.to_clip.data()[result.to_clip_count++] =
                first + at + static_cast<std::uint32_t>(__builtin_ctz(rest));
    }
    result.visible_count = static_cast<std::size_t>(visible - result.visible.data());
}

// Prefetches the vertices of triangles so many registers ahead: one vertex each, as neighbours lie
// in the same cache lines.
constexpr int kRegistersAhead = 2;
SIMD_INLINE void prefetch_vertices(const ScreenVertex* vertices, const std::uint32_t* index) {
    for (int lane = 0; lane < kLanes; ++lane)
        __builtin_prefetch(vertices + index[(kRegistersAhead * kLanes + lane) * 3]);
}

void cull_all(const CullOptions& o, const ScreenVertex* vertices, const std::uint32_t* index,
              int count, std::uint32_t first, CullResult& result) {
    constexpr std::size_t kIndices = 3 * sizeof(std::uint32_t), kAhead = 96; // triangles
    FoundLanes found;
    for (int i = 0; i < count;) {
        const int begin = i;
        int r = 0;
        for (; r < FoundLanes::kRegisters && i + kLanes <= count; ++r, i += kLanes) {
            // A register takes too long for the hardware prefetcher to stay ahead.
            const std::uint32_t* of_lanes = index + std::ptrdiff_t{i} * 3;
            prefetch<kLanes * kIndices>(of_lanes, kAhead * kIndices);
            if (i + (kRegistersAhead + 1) * kLanes <= count) prefetch_vertices(vertices, of_lanes);
            cull_lanes(o, vertices_of(vertices, of_lanes), kLanes, r, found);
        }
        if (r < FoundLanes::kRegisters && i < count) {
            std::uint32_t rest[kLanes * 3];
            for (int k = 0; k < kLanes * 3; ++k)
                rest[k] = index[k < (count - i) * 3 ? i * 3 + k : 0];
            cull_lanes(o, vertices_of(vertices, rest), count - i, r++, found);
            i = count;
        }
        list(found, r, first + static_cast<std::uint32_t>(begin), result);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(cull_all);

bool keeps_facing(const CullOptions& options, bool clockwise) {
    const bool front = !clockwise != options.mirrored;
    return options.keep == Facing::any || (options.keep == Facing::front) == front;
}

void cull_triangles(const CullOptions& options, std::span<const ScreenVertex> vertices,
                    std::span<const std::uint32_t> index, std::uint32_t first, CullResult& result) {
    result.visible_count = result.to_clip_count = 0;
    const std::size_t padded = index.size() / 3 + kRegisterPadding;
    if (result.visible.size() < padded) {
        result.visible.resize(padded);
        result.to_clip.resize(padded);
    }
    if (index.empty()) return;
    SIMD_CALL(cull_all, options, vertices.data(), index.data(), static_cast<int>(index.size() / 3),
              first, result);
}

} // namespace scanout::raster
#endif
