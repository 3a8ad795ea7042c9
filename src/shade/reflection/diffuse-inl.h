// The ambient and diffuse part that the reflection models share.
#if defined(SCANOUT_SHADE_DIFFUSE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_DIFFUSE_INL_H
#undef SCANOUT_SHADE_DIFFUSE_INL_H
#else
#define SCANOUT_SHADE_DIFFUSE_INL_H
#endif

#include "shade/reflection/light-inl.h"

SIMD_BEGIN(scanout::shade::reflection)

// Sets b.colour; lines and points get their plain albedo.
HWY_INLINE void diffuse(Block& b, const FrameState& frame) {
    const std::size_t light_count = b.lit ? frame.lights.size() : 0;
    const F32 ambient[3] = {b.lit ? b.ambient.x : 1.0F, b.lit ? b.ambient.y : 1.0F,
                            b.lit ? b.ambient.z : 1.0F};
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 nx = load<F32>(b.normal[0] + i), ny = load<F32>(b.normal[1] + i),
                  nz = load<F32>(b.normal[2] + i);
        F32 red = ambient[0], green = ambient[1], blue = ambient[2];
        for (std::size_t k = 0; k < light_count; ++k) {
            const Light l = light_at(b, frame, k, i);
            const F32 cosine = (nx * l.towards[0] + ny * l.towards[1]) + nz * l.towards[2];
            const F32 facing = maximum(cosine, F32(0.0F));
            red = red + l.colour[0] * facing;
            green = green + l.colour[1] * facing;
            blue = blue + l.colour[2] * facing;
        }
        store(load<F32>(b.albedo[0] + i) * red, b.colour[0] + i);
        store(load<F32>(b.albedo[1] + i) * green, b.colour[1] + i);
        store(load<F32>(b.albedo[2] + i) * blue, b.colour[2] + i);
    }
}

SIMD_END

#endif
