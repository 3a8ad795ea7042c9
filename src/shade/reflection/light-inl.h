// A light at a register of lanes, whether it is the same everywhere or varies.
#if defined(SCANOUT_SHADE_LIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_LIGHT_INL_H
#undef SCANOUT_SHADE_LIGHT_INL_H
#else
#define SCANOUT_SHADE_LIGHT_INL_H
#endif

#include "shade/stage.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade::reflection)

struct Light {
    F32 towards[3]; // unit, view space
    F32 colour[3];  // linear
};

SIMD_INLINE bool varies(const FrameState& frame, std::size_t k) {
    return !frame.varies.empty() && frame.varies.data()[k];
}
// Of a light that does not vary.
SIMD_INLINE Light light_everywhere(const FrameState& frame, std::size_t k) {
    const scene::ViewLight& l = frame.lights.data()[k];
    return {{F32(l.towards.x), F32(l.towards.y), F32(l.towards.z)},
            {F32(l.colour.x), F32(l.colour.y), F32(l.colour.z)}};
}
SIMD_INLINE Light light_at(const Block& b, const FrameState& frame, std::size_t k, int lane) {
    if (!varies(frame, k)) return light_everywhere(frame, k);
    const LightLanes& l = b.light.data()[k];
    return {{load<F32>(l.towards[0] + lane), load<F32>(l.towards[1] + lane),
             load<F32>(l.towards[2] + lane)},
            {load<F32>(l.colour[0] + lane), load<F32>(l.colour[1] + lane),
             load<F32>(l.colour[2] + lane)}};
}

SIMD_END

#endif
