#include "raster/cull.h"

#define SIMD_FILE "raster/cull.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::raster)

using Mask32 = Mask<F32::Tag>;

// First and last + 1 pixel whose samples, between low and high, may lie in [min, max].
HWY_INLINE I32 first_pixel(I32 min, std::int32_t high) {
    return shift_right<kSubpixelBits>(min + I32(kSubpixel - 1 - high));
}
HWY_INLINE I32 end_pixel(I32 max, std::int32_t low) {
    return shift_right<kSubpixelBits>(max + I32(kSubpixel - low));
}

struct Corners {
    I32 x[3], y[3];
};

HWY_INLINE Corners corners(const ScreenVertex* vertices, const std::uint32_t* index) {
    I32 v[3];
    load_interleaved(index, v[0], v[1], v[2]);
    Corners c;
    const auto* base = reinterpret_cast<const std::int32_t*>(vertices);
    for (int k = 0; k < 3; ++k) {
        const I32 at = shift_left<2>(v[k]); // 16 bytes a vertex
        c.x[k] = gather(base, at);
        c.y[k] = gather(base + 1, at);
    }
    return c;
}

// live: how many of the lanes are triangles.
HWY_INLINE void cull_lanes(const CullOptions& o, const Corners& c, int live, std::uint32_t first,
                           CullResult& result) {
    const I32 off = ScreenVertex::kOffScreen;
    const Mask32 off0 = c.x[0] == off, off1 = c.x[1] == off, off2 = c.x[2] == off;
    const Mask32 any_off = off0 | off1 | off2;

    // Twice the area, exact in double: |dx|, |dy| <= 2^24. A float keeps its sign and its zero.
    const F64 dx1 = to_f64(c.x[1] - c.x[0]), dy1 = to_f64(c.y[1] - c.y[0]);
    const F64 dx2 = to_f64(c.x[2] - c.x[0]), dy2 = to_f64(c.y[2] - c.y[0]);
    const F32 area = to_f32(dx1 * dy2 - dy1 * dx2);
    // Counter-clockwise is front, unless the view mirrors. Area 0 covers nothing (HARD-CASES 4).
    const bool both = o.keep == Facing::any, clockwise = (o.keep == Facing::front) == o.mirrored;
    Mask32 kept = !any_off;
    if (both || clockwise) kept = both ? kept & !(area == F32(0.0F)) : kept & (area > F32(0.0F));
    if (!both && !clockwise) kept = kept & (area < F32(0.0F));

    const I32 min_x = minimum(minimum(c.x[0], c.x[1]), c.x[2]);
    const I32 max_x = maximum(maximum(c.x[0], c.x[1]), c.x[2]);
    const I32 min_y = minimum(minimum(c.y[0], c.y[1]), c.y[2]);
    const I32 max_y = maximum(maximum(c.y[0], c.y[1]), c.y[2]);
    const I32 x0 = maximum(first_pixel(min_x, o.extent.high.x), 0);
    const I32 y0 = maximum(first_pixel(min_y, o.extent.high.y), 0);
    const I32 x1 = minimum(end_pixel(max_x, o.extent.low.x), o.width);
    const I32 y1 = minimum(end_pixel(max_y, o.extent.low.y), o.height);
    kept = kept & (x0 < x1) & (y0 < y1);

    // Off the screen at one side with all corners, or not a number: gone without clipping.
    const I32 all_flags =
        select(off0, c.y[0], 0) & select(off1, c.y[1], 0) & select(off2, c.y[2], 0);
    const I32 any_flags =
        select(off0, c.y[0], 0) | select(off1, c.y[1], 0) | select(off2, c.y[2], 0);
    const Mask32 inside = (all_flags & I32(kOutsideMask)) == I32(0);
    const Mask32 finite = (any_flags & I32(kNotFinite)) == I32(0);
    const Mask32 cut = any_off & (inside & finite);

    const std::uint32_t lanes = (2U << (live - 1)) - 1;
    std::uint32_t todo = bits(kept) & lanes;
    if (todo != 0) {
        std::int32_t box[4][kLanes];
        store(x0, box[0]);
        store(y0, box[1]);
        store(x1, box[2]);
        store(y1, box[3]);
        for (; todo != 0; todo &= todo - 1) {
            const int i = __builtin_ctz(todo);
            KeptTriangle& t = result.kept.data()[result.kept_count++];
            t.triangle = first + static_cast<std::uint32_t>(i);
            t.x0 = static_cast<std::int16_t>(box[0][i]);
            t.y0 = static_cast<std::int16_t>(box[1][i]);
            t.x1 = static_cast<std::int16_t>(box[2][i]);
            t.y1 = static_cast<std::int16_t>(box[3][i]);
        }
    }
    for (todo = bits(cut) & lanes; todo != 0; todo &= todo - 1)
        result.cut.data()[result.cut_count++] =
            first + static_cast<std::uint32_t>(__builtin_ctz(todo));
}

void cull_all(const CullOptions& o, const ScreenVertex* vertices, const std::uint32_t* index,
              int count, std::uint32_t first, CullResult& result) {
    int i = 0;
    for (; i + kLanes <= count; i += kLanes)
        cull_lanes(o, corners(vertices, index + std::ptrdiff_t{i} * 3), kLanes,
                   first + static_cast<std::uint32_t>(i), result);
    if (i == count) return;
    std::uint32_t rest[kLanes * 3];
    for (int k = 0; k < kLanes * 3; ++k)
        rest[k] = index[k < (count - i) * 3 ? i * 3 + k : 0];
    cull_lanes(o, corners(vertices, rest), count - i, first + static_cast<std::uint32_t>(i),
               result);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(cull_all);

bool faces_as_wanted(const CullOptions& options, bool clockwise) {
    const bool front = !clockwise != options.mirrored;
    return options.keep == Facing::any || (options.keep == Facing::front) == front;
}

void cull(const CullOptions& options, std::span<const ScreenVertex> vertices,
          std::span<const std::uint32_t> index, std::uint32_t first, CullResult& result) {
    result.kept_count = result.cut_count = 0;
    if (index.empty()) return;
    SIMD_CALL(cull_all)
    (options, vertices.data(), index.data(), static_cast<int>(index.size() / 3), first, result);
}

} // namespace scanout::raster
#endif
