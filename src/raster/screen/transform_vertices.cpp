// ScreenTransform::transform in lanes: the same operations in the same order, so the same bits.
#include "raster/check_lanes.h"
#include "raster/screen/screen.h"

#include <algorithm>

#define SIMD_FILE "raster/screen/transform_vertices.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::raster)

struct Lanes {
    I32 x, y; // as in ScreenVertex
    F64 depth;
    F64 pixel_x, pixel_y; // before they snap
};

SIMD_INLINE F64 flag(F64::DoubleMask outside, std::uint32_t bit) {
    return select(outside, F64(bit), F64(0.0));
}

// Round to the grid, ties to even, saturated; NaN becomes a number (HARD-CASES R1, R2).
SIMD_INLINE F64 snap(F64 pixels) {
    const F64 limit = kGuardPixels * kSubpixel;
    const F64 v = minimum(maximum(pixels * F64(kSubpixel), -limit), limit);
    return (v + F64(0x1.8p52)) - F64(0x1.8p52);
}

// In clip space, with w (ScreenTransform::to_clip).
struct ClipLanes {
    F64 x, y, z, w;
};
SIMD_INLINE ClipLanes to_clip(const ScreenTransform& t, F64 px, F64 py, F64 pz) {
    const auto axis = [&](int r) {
        return ((F64(t.linear[r][0]) * px + F64(t.linear[r][1]) * py) + F64(t.linear[r][2]) * pz) +
               F64(t.translation[r]);
    };
    const F64 view_x = axis(0), view_y = axis(1), view_z = axis(2);
    ClipLanes c;
    c.w = t.perspective ? -view_z : F64(1.0);
    c.x = view_x * F64(t.scale_x) + c.w * F64(t.centre_x);
    c.y = c.w * F64(t.centre_y) - view_y * F64(t.scale_y);
    c.z = t.perspective ? F64(t.box.near_w) : (view_z - F64(t.depth_origin)) * F64(t.depth_scale);
    return c;
}

// Any vertices.
HWY_NOINLINE Lanes transform_any(const ScreenTransform& t, const ClipLanes& c) {
    const F64 x = c.x, y = c.y, z = c.z, w = c.w, most = 0x1.fffffffffffffp1023;
    const auto finite = (abs(x) <= most) & (abs(y) <= most) &
                        (abs(z) <= F64(kMaxDepth * t.box.near_w)) & (abs(w) <= most);
    const auto near = w < F64(t.box.near_w);
    const auto guard = (x < F64(t.box.left) * w) | (x > F64(t.box.right) * w) |
                       (y < F64(t.box.top) * w) | (y > F64(t.box.bottom) * w);
    const F64 outside =
        ((flag(x < F64(0.0), kOutsideLeft) + flag(x > F64(t.width) * w, kOutsideRight)) +
         (flag(y < F64(0.0), kOutsideTop) + flag(y > F64(t.height) * w, kOutsideBottom))) +
        (flag(near, kOutsideNear) + flag(guard, kOutsideGuard));
    const auto on_screen = finite & !(near | guard);

    const F64 divisor = select(on_screen, w, F64(1.0));
    const F64 none = ScreenVertex::kOffScreen;
    const F64 flags = select(finite, outside, F64(kNotFinite));
    const auto over_w = [&](F64 a) { return t.perspective ? a / divisor : a; }; // else w is 1
    const F64 pixel_x = over_w(x), pixel_y = over_w(y);
    return {to_i32(select(on_screen, snap(pixel_x), none)),
            to_i32(select(on_screen, snap(pixel_y), flags)), select(on_screen, over_w(z), F64(0.0)),
            pixel_x, pixel_y};
}

// Constants of the view for vertices on the screen.
struct OnScreenTerms {
    double guard;    // the guard band at its narrowest, pixels
    double per_near; // about 1 / near_w
};

// The same for registers of vertices on the screen, nearly all. Returns false where a lane is not,
// or where x / w or y / w might snap differently. Multiplies by the depth, which is a quotient
// already, instead of dividing: the error is less than 2^-50 of the product and less than 2^-27 of
// a step, so only vertices that close to the middle between two steps need divisions of their own.
SIMD_INLINE bool transform_on_screen(const OnScreenTerms& terms, const ScreenTransform& t,
                                     const ClipLanes& c, Lanes& out) {
    const F64 reach = F64(terms.guard) * c.w, near = t.box.near_w, most = 0x1p900;
    const auto inside = (c.w >= near) & (c.w <= most) & (abs(c.x) <= reach) & (abs(c.y) <= reach) &
                        (abs(c.z) <= F64(kMaxDepth) * near); // false for NaN
    out.depth = t.perspective ? near / c.w : c.z;
    const F64 over_w = t.perspective ? out.depth * F64(terms.per_near) : F64(1.0);
    const F64 shift = 0x1.8p52;
    out.pixel_x = c.x * over_w;
    out.pixel_y = c.y * over_w;
    const F64 x = out.pixel_x * F64(kSubpixel), y = out.pixel_y * F64(kSubpixel);
    const F64 snapped_x = (x + shift) - shift, snapped_y = (y + shift) - shift;
    const F64 clear = 0.5 - 0x1p-26;
    const auto certain = (abs(x - snapped_x) <= clear) & (abs(y - snapped_y) <= clear);
    if (!all(inside & certain)) return false;
    out.x = to_i32(snapped_x);
    out.y = to_i32(snapped_y);
    return true;
}

SIMD_INLINE void transform_lanes(const OnScreenTerms& terms, const ScreenTransform& t,
                                 const float* position, ScreenVertex* out, int first, int count) {
    out += first;
    F32 x, y, z;
    load_interleaved(position, x, y, z);
    const ClipLanes clip = to_clip(t, to_f64(x), to_f64(y), to_f64(z));
    Lanes v;
    if (!transform_on_screen(terms, t, clip, v)) v = transform_any(t, clip);
    static_assert(offsetof(ScreenVertex, y) == 4 && offsetof(ScreenVertex, depth) == 8);
    if (count == kLanes) {
        store_interleaved(v.x, v.y, v.depth, out);
    } else {
        ScreenVertex all[kLanes];
        store_interleaved(v.x, v.y, v.depth, all);
        for (int i = 0; i < count; ++i)
            out[i] = all[i];
    }
    if constexpr (kCheckLanes) {
        double pixel_x[kLanes], pixel_y[kLanes];
        store(v.pixel_x, pixel_x);
        store(v.pixel_y, pixel_y);
        for (int i = 0; i < count; ++i)
            if (out[i].on_screen())
                check_before_snap(pixel_x[i], pixel_y[i], static_cast<std::size_t>(first + i));
    }
}

// position: x, y, z of each vertex.
void transform_all(const ScreenTransform& t, const float* position, ScreenVertex* out, int count) {
    constexpr std::size_t kAhead = 96; // vertices
    const double narrowest =
        std::min(std::min(-t.box.left, t.box.right), std::min(-t.box.top, t.box.bottom));
    const OnScreenTerms terms{narrowest, 1 / t.box.near_w};
    int i = 0;
    for (; i + kLanes <= count; i += kLanes) {
        // A register takes so long that the hardware prefetcher falls behind: prefetches by
        // software.
        const float* of_lanes = position + std::ptrdiff_t{i} * 3;
        prefetch<kLanes * sizeof(Vec3)>(of_lanes, kAhead * sizeof(Vec3));
        prefetch<kLanes * sizeof(ScreenVertex)>(out + i, kAhead * sizeof(ScreenVertex));
        transform_lanes(terms, t, of_lanes, out, i, kLanes);
    }
    if (i == count) return;
    float rest[kLanes * 3] = {};
    for (int k = 0; k < (count - i) * 3; ++k)
        rest[k] = position[i * 3 + k];
    transform_lanes(terms, t, rest, out, i, count - i);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::raster {

SIMD_REGISTER(transform_all);

void transform_vertices(const ScreenTransform& transform, std::span<const Vec3> positions,
                        std::span<ScreenVertex> out) {
    static_assert(sizeof(Vec3) == 3 * sizeof(float));
    if (positions.empty()) return;
    SIMD_CALL(transform_all, transform, &positions.front().x, out.data(),
              static_cast<int>(positions.size()));
}

} // namespace scanout::raster
#endif
