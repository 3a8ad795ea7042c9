// The ambient and diffuse part that the reflection models share.
#if defined(SCANOUT_SHADE_DIFFUSE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_DIFFUSE_INL_H
#undef SCANOUT_SHADE_DIFFUSE_INL_H
#else
#define SCANOUT_SHADE_DIFFUSE_INL_H
#endif

#include "shade/reflection/light-inl.h"

SIMD_BEGIN(scanout::shade::reflection)

struct Colour {
    F32 red, green, blue;
};
SIMD_INLINE void store_colour(const Colour& c, Block& b, int lane) {
    store(c.red, b.colour[0] + lane);
    store(c.green, b.colour[1] + lane);
    store(c.blue, b.colour[2] + lane);
}

// Lines and points show their plain albedo.
SIMD_INLINE Colour ambient_of(const Block& b) {
    if (!b.lit) return {F32(1.0F), F32(1.0F), F32(1.0F)};
    return {F32(b.ambient.x), F32(b.ambient.y), F32(b.ambient.z)};
}

// Of a register of lanes.
SIMD_INLINE Colour diffuse_at(const Block& b, const FrameState& frame, const Colour& ambient,
                              std::size_t light_count, int lane) {
    const F32 nx = load<F32>(b.normal[0] + lane), ny = load<F32>(b.normal[1] + lane),
              nz = load<F32>(b.normal[2] + lane);
    Colour sum = ambient;
    for (std::size_t k = 0; k < light_count; ++k) {
        const Light l = light_at(b, frame, k, lane);
        const F32 cosine = (nx * l.towards[0] + ny * l.towards[1]) + nz * l.towards[2];
        const F32 facing = maximum(cosine, F32(0.0F));
        sum.red = sum.red + l.colour[0] * facing;
        sum.green = sum.green + l.colour[1] * facing;
        sum.blue = sum.blue + l.colour[2] * facing;
    }
    return {load<F32>(b.albedo[0] + lane) * sum.red, load<F32>(b.albedo[1] + lane) * sum.green,
            load<F32>(b.albedo[2] + lane) * sum.blue};
}

// Sets b.colour.
SIMD_INLINE void diffuse(Block& b, const FrameState& frame) {
    const std::size_t light_count = b.lit ? frame.lights.size() : 0;
    const Colour ambient = ambient_of(b);
    for (int i = 0; i < b.count; i += kLanes)
        store_colour(diffuse_at(b, frame, ambient, light_count, i), b, i);
}

SIMD_END

#endif
