// What a sample shows of a primitive that covers it. Included once for every SIMD target.
#if defined(SCANOUT_RASTER_SHOW_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_SHOW_INL_H
#undef SCANOUT_RASTER_SHOW_INL_H
#else
#define SCANOUT_RASTER_SHOW_INL_H
#endif

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::raster)

using MaskX8 = Mask<F32x8::Tag>;

// Of what is inside the nearest stays, at a tie the lower id.
HWY_INLINE void show(MaskX8 inside, F32x8 z, std::uint32_t primitive, float* depth,
                     std::uint32_t* id, I32x8& drawn) {
    const F32x8 old = load<F32x8>(depth);
    const I32x8 old_id = load<I32x8>(id), new_id = static_cast<std::int32_t>(primitive);
    // Ids are compared as unsigned numbers: their order is that of signed ones moved by 2^31.
    const I32x8 half = INT32_MIN;
    const MaskX8 pass = inside & ((z > old) | ((z == old) & ((new_id + half) < (old_id + half))));
    store(select(pass, z, old), depth);
    store(select(pass, new_id, old_id), id);
    drawn = select(pass, I32x8(-1), drawn);
}

SIMD_END

#endif
