// What the light stages share: a loop over the lights of a kind that vary, and how a light at a
// place reaches a lane.
#if defined(SCANOUT_SHADE_LIGHT_WRITE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_LIGHT_WRITE_INL_H
#undef SCANOUT_SHADE_LIGHT_WRITE_INL_H
#else
#define SCANOUT_SHADE_LIGHT_WRITE_INL_H
#endif

#include "shade/stage.h"

#include "simd/vec3-inl.h"

SIMD_BEGIN(scanout::shade::light)

// write(light, lanes, first lane) for every register of every light of the kind.
template <class Write>
SIMD_INLINE void for_each_lane(ShadingBlock& b, const FrameState& frame, scene::LightKind kind,
                               Write write) {
    if (!b.lit || frame.varies.empty()) return;
    const std::size_t count = frame.lights.size();
    for (std::size_t k = 0; k < count; ++k) {
        const scene::ViewLight& light = frame.lights.data()[k];
        if (light.kind != kind || !frame.varies.data()[k]) continue;
        BlockLight& lanes = b.light.data()[k];
        for (int i = 0; i < b.count; i += kLanes)
            write(light, lanes, i);
    }
}

struct Arrival {
    Vec3F32 towards; // unit
    F32 attenuation; // of the light's colour
};

// By the inverse square of the distance. On the light itself there is no direction: nothing
// arrives.
SIMD_INLINE Arrival arrival(const ShadingBlock& b, const scene::ViewLight& light, int item) {
    const Vec3F32 way = everywhere<Vec3F32>(light.position) - load_vec3<Vec3F32>(b.position, item);
    const F32 square = length_squared(way);
    const F32 inverse = F32(1.0F) / sqrt(maximum(square, F32(0x1p-100F)));
    const F32 nearest = light.nearest * light.nearest;
    return {way * inverse, F32(light.reach * light.reach) / maximum(square, nearest)};
}

SIMD_INLINE void store_arrival(const Arrival& a, const scene::ViewLight& light, BlockLight& lanes,
                               int item) {
    store_vec3(a.towards, lanes.towards, item);
    store_vec3(everywhere<Vec3F32>(light.colour) * a.attenuation, lanes.colour, item);
}

SIMD_END

#endif
