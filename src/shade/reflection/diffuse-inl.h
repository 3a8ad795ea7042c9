// The ambient and diffuse part that the reflection models share.
#if defined(SCANOUT_SHADE_DIFFUSE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_DIFFUSE_INL_H
#undef SCANOUT_SHADE_DIFFUSE_INL_H
#else
#define SCANOUT_SHADE_DIFFUSE_INL_H
#endif

#include "shade/reflection/light-inl.h"

SIMD_BEGIN(scanout::shade::reflection)

// The light that comes from everywhere; of lines and points, which show their plain albedo, 1.
struct Ambient {
    Vec3F32 even;     // the same at all items
    bool hemispheres; // some differs from item to item
};
SIMD_INLINE Ambient ambient_of(const ShadingBlock& b) {
    if (!b.lit) return {splat(F32(1.0F)), false};
    return {everywhere<Vec3F32>(b.ambient), b.hemispheres};
}
SIMD_INLINE Vec3F32 ambient_at(const ShadingBlock& b, const Ambient& ambient, int item) {
    if (!ambient.hemispheres) return ambient.even;
    return ambient.even + load_vec3<Vec3F32>(b.from_hemispheres, item);
}

// Of a register of lanes.
SIMD_INLINE Vec3F32 diffuse_at(const ShadingBlock& b, const FrameState& frame,
                               const Ambient& ambient, std::size_t light_count, int item) {
    const Vec3F32 normal = load_vec3<Vec3F32>(b.normal, item);
    Vec3F32 sum = ambient_at(b, ambient, item);
    for (std::size_t k = 0; k < light_count; ++k) {
        const Light l = light_at(b, frame, k, item);
        sum = sum + l.colour * maximum(dot(normal, l.towards), F32(0.0F));
    }
    return load_vec3<Vec3F32>(b.albedo, item) * sum;
}

// Sets b.colour.
SIMD_INLINE void diffuse(ShadingBlock& b, const FrameState& frame) {
    const std::size_t light_count = b.lit ? frame.lights.size() : 0;
    const Ambient ambient = ambient_of(b);
    for (int i = 0; i < b.count; i += kLanes)
        store_vec3(diffuse_at(b, frame, ambient, light_count, i), b.colour, i);
}

SIMD_END

#endif
