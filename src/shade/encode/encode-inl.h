// The part that all encodings share. Each encoding brings two functions:
//     I32 nearest(F32 light)    the code, 0 to 255
//     F32 fraction(F32 light)   the same before it is rounded, for dither; in [0, 255], within
//                               1/128 of a whole number where the light is that of a code
#if defined(SCANOUT_SHADE_ENCODE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_ENCODE_INL_H
#undef SCANOUT_SHADE_ENCODE_INL_H
#else
#define SCANOUT_SHADE_ENCODE_INL_H
#endif

#include "shade/resolve/output.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade::encode)

// [0, 1]; NaN: 0.
SIMD_INLINE F32 clamped(F32 light) {
    return minimum(maximum(light, F32(0.0F)), F32(1.0F));
}

template <class Codes, bool kAlpha, bool kDither>
SIMD_INLINE void encode_rows(const Light& light, int count, std::uint32_t* out) {
    for (int i = 0; i < count; i += kLanes) {
        const auto code = [&](const float* channel) SIMD_LAMBDA {
            const F32 value = load<F32>(channel + i);
            if constexpr (kDither)
                return to_i32(Codes::fraction(value) + load<F32>(light.offset + i));
            else
                return Codes::nearest(value);
        };
        const I32 red = code(light.red), green = code(light.green), blue = code(light.blue);
        I32 alpha = 255;
        if constexpr (kAlpha) alpha = load<I32>(light.alpha + i);
        store((red | shift_left<8>(green)) | (shift_left<16>(blue) | shift_left<24>(alpha)),
              out + i);
    }
}

template <class Codes>
SIMD_INLINE void encode_all(const Light& light, int count, std::uint32_t* out) {
    if (light.offset != nullptr) {
        if (light.alpha != nullptr) return encode_rows<Codes, true, true>(light, count, out);
        return encode_rows<Codes, false, true>(light, count, out);
    }
    if (light.alpha != nullptr) return encode_rows<Codes, true, false>(light, count, out);
    encode_rows<Codes, false, false>(light, count, out);
}

SIMD_END

#endif
