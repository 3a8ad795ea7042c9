// One number from a map: of the channel that -imfchan names, else how bright the texel is.
#if defined(SCANOUT_SHADE_SCALAR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_SCALAR_INL_H
#undef SCANOUT_SHADE_SCALAR_INL_H
#else
#define SCANOUT_SHADE_SCALAR_INL_H
#endif

#include "shade/map/scalar.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade::map)

SIMD_INLINE F32 scalar_at(const ShadingBlock& b, const BoundMap& map, int item) {
    switch (map.map->channel) {
    case 'r':
        return load<F32>(b.sampled[0] + item);
    case 'g':
        return load<F32>(b.sampled[1] + item);
    case 'b':
        return load<F32>(b.sampled[2] + item);
    case 'm':
        return load<F32>(b.sampled[3] + item);
    default:
        break;
    }
    // Rec. 709; written so that a grey is itself, to the bit.
    const F32 red = load<F32>(b.sampled[0] + item), green = load<F32>(b.sampled[1] + item),
              blue = load<F32>(b.sampled[2] + item);
    return green + (F32(0.2126F) * (red - green) + F32(0.0722F) * (blue - green));
}

SIMD_END

#endif
