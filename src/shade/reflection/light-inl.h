// A light at a register of lanes, whether it is the same everywhere or varies.
#if defined(SCANOUT_SHADE_LIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_LIGHT_INL_H
#undef SCANOUT_SHADE_LIGHT_INL_H
#else
#define SCANOUT_SHADE_LIGHT_INL_H
#endif

#include "shade/stage.h"

#include "simd/vec3-inl.h"

SIMD_BEGIN(scanout::shade::reflection)

struct Light {
    Vec3F32 towards; // unit, view space
    Vec3F32 colour;  // linear
};

SIMD_INLINE bool varies(const FrameState& frame, std::size_t k) {
    return !frame.varies.empty() && frame.varies.data()[k];
}
// Of a light that does not vary.
SIMD_INLINE Light light_everywhere(const FrameState& frame, std::size_t k) {
    const scene::ViewLight& l = frame.lights.data()[k];
    return {everywhere<Vec3F32>(l.towards), everywhere<Vec3F32>(l.colour)};
}
SIMD_INLINE Light light_at(const ShadingBlock& b, const FrameState& frame, std::size_t k,
                           int item) {
    if (!varies(frame, k)) return light_everywhere(frame, k);
    const BlockLight& l = b.light.data()[k];
    return {load_vec3<Vec3F32>(l.towards, item), load_vec3<Vec3F32>(l.colour, item)};
}

SIMD_END

#endif
