#include "shade/place_lanes.h"

#define SIMD_FILE "shade/place_lanes.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::shade)

// 1 where the triangle covers the point, else 0.
HWY_INLINE F32x8 covers(const Primitive& t, I32x8 x, I32x8 y) {
    const F64x8 px = to_f64(x), py = to_f64(y);
    const auto inside = [&](int k) {
        const F64x8 weight = (F64x8(t.a[k]) * px + F64x8(t.b[k]) * py) + F64x8(t.c[k]);
        return weight >= F64x8(t.least[k]);
    };
    return to_f32(select(inside(0) & inside(1) & inside(2), F64x8(1.0), F64x8(0.0)));
}

void place(Block& b, const FrameState& frame, const Rays& rays) {
    for (const Run* run = b.run; run != b.run + b.runs; ++run) {
        for (int k = 0; k < run->count; k += kLanesX8) {
            I32x8 x = I32x8(run->x) + shift_left<8>(iota<I32x8>(k)), y = run->y;
            if ((run->dx | run->dy) != 0) {
                const auto centre = covers(*run->primitive, x, y) > F32x8(0.5F);
                x = select(centre, x, x + I32x8(run->dx));
                y = select(centre, y, y + I32x8(run->dy));
            }
            store(x, b.x + run->first + k);
            store(y, b.y + run->first + k);
        }
    }
    if (!frame.attributes.ray) return;
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 x = to_f32(load<I32>(b.x + i)) * F32(1.0F / 256);
        const F32 y = to_f32(load<I32>(b.y + i)) * F32(1.0F / 256);
        store(x * F32(rays.scale_x) + F32(rays.offset_x), b.ray_x + i);
        store(y * F32(rays.scale_y) + F32(rays.offset_y), b.ray_y + i);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade {

SIMD_REGISTER(place);

void place_lanes(Block& block, const FrameState& frame, const Rays& rays) {
    SIMD_CALL(place)(block, frame, rays);
}

} // namespace scanout::shade
#endif
