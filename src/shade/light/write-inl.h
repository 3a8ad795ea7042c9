// What the light stages share: a loop over the lights of a kind that vary, and how a light at a
// place reaches a lane.
#if defined(SCANOUT_SHADE_LIGHT_WRITE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_LIGHT_WRITE_INL_H
#undef SCANOUT_SHADE_LIGHT_WRITE_INL_H
#else
#define SCANOUT_SHADE_LIGHT_WRITE_INL_H
#endif

#include "shade/stage.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade::light)

// write(light, lanes, first lane) for every register of every light of the kind.
template <class Write>
SIMD_INLINE void for_each_lane(Block& b, const FrameState& frame, scene::LightKind kind,
                               Write write) {
    if (!b.lit || frame.varies.empty()) return;
    const std::size_t count = frame.lights.size();
    for (std::size_t k = 0; k < count; ++k) {
        const scene::ViewLight& light = frame.lights.data()[k];
        if (light.kind != kind || !frame.varies.data()[k]) continue;
        LightLanes& lanes = b.light.data()[k];
        for (int i = 0; i < b.count; i += kLanes)
            write(light, lanes, i);
    }
}

struct Arrival {
    F32 towards[3]; // unit
    F32 share;      // of the light's colour
};

// By the inverse square of the distance. On the light itself there is no direction: nothing
// arrives.
SIMD_INLINE Arrival arrival(const Block& b, const scene::ViewLight& light, int lane) {
    const F32 x = F32(light.position.x) - load<F32>(b.position[0] + lane);
    const F32 y = F32(light.position.y) - load<F32>(b.position[1] + lane);
    const F32 z = F32(light.position.z) - load<F32>(b.position[2] + lane);
    const F32 square = (x * x + y * y) + z * z;
    const F32 inverse = F32(1.0F) / sqrt(maximum(square, F32(0x1p-100F)));
    const F32 nearest = light.nearest * light.nearest;
    return {{x * inverse, y * inverse, z * inverse},
            F32(light.reach * light.reach) / maximum(square, nearest)};
}

SIMD_INLINE void store_arrival(const Arrival& a, const scene::ViewLight& light, LightLanes& lanes,
                               int lane) {
    for (int c = 0; c < 3; ++c)
        store(a.towards[c], lanes.towards[c] + lane);
    store(F32(light.colour.x) * a.share, lanes.colour[0] + lane);
    store(F32(light.colour.y) * a.share, lanes.colour[1] + lane);
    store(F32(light.colour.z) * a.share, lanes.colour[2] + lane);
}

SIMD_END

#endif
