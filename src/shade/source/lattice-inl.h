// A lattice laid over a texture's turn, for the procedural sources: cells, hashes of cells, and how
// many cells a pixel spans.
#if defined(SCANOUT_SHADE_LATTICE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_LATTICE_INL_H
#undef SCANOUT_SHADE_LATTICE_INL_H
#else
#define SCANOUT_SHADE_LATTICE_INL_H
#endif

#include "shade/mip/texel-inl.h"

SIMD_BEGIN(scanout::shade::source)

using texture::HWY_NAMESPACE::floor_to_int;

// u without whole turns, in [0, 1]: large coordinates keep their precision. NaN gives 0.
SIMD_INLINE F32 turn(F32 u) {
    const F32 safe = texture::HWY_NAMESPACE::convertible(u);
    return safe - to_f32(floor_to_int(safe));
}

// The longer of a coordinate's two steps from pixel to pixel, within [0, 2^30].
SIMD_INLINE F32 span(F32 right, F32 down) {
    return minimum(maximum(abs(right), abs(down)), F32(0x1p30F));
}

SIMD_INLINE I32 exclusive_or(I32 a, I32 b) {
    return (a | b) - (a & b);
}
template <int kCount>
SIMD_INLINE I32 shifted_down(I32 a) { // zeros come in
    return shift_right<kCount>(a) & I32((1 << (32 - kCount)) - 1);
}

// lowbias32: Wellons 2018.
SIMD_INLINE I32 hash(I32 x) {
    x = exclusive_or(x, shifted_down<16>(x)) * I32(0x7feb352d);
    x = exclusive_or(x, shifted_down<15>(x)) * I32(static_cast<std::int32_t>(0x846ca68bU));
    return exclusive_or(x, shifted_down<16>(x));
}

SIMD_INLINE void store_grey(ShadingBlock& b, int item, F32 value) {
    for (int c = 0; c < 3; ++c)
        store(value, b.sampled[c] + item);
}

SIMD_END

#endif
