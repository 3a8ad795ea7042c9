// srgb_encode and srgb_decode of math/srgb.h in lanes: the same tables, so the same results.
#if defined(SCANOUT_MATH_SRGB_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_MATH_SRGB_INL_H
#undef SCANOUT_MATH_SRGB_INL_H
#else
#define SCANOUT_MATH_SRGB_INL_H
#endif

#include "math/srgb.h"

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace scanout::simd::HWY_NAMESPACE {

// code in [0, 255].
template <class D>
SIMD_INLINE Float<D> srgb_decode(Int<D> code) {
    return gather(::scanout::detail::kSrgb.decode, code);
}

// Clamps to [0, 1]; NaN gives 0; monotone.
template <class D>
SIMD_INLINE Int<D> srgb_encode(Float<D> linear) {
    using namespace ::scanout::detail;
    using F = Float<D>;
    const F x = minimum(maximum(linear, F(kSrgbLowest)), F(kSrgbHighest)); // NaN: the lowest
    const Int<D> offset = bits_of(x) - bits_of(F(kSrgbLowest));
    const Int<D> bucket = gather(kSrgb.bucket, shift_right<kSrgbBucketShift>(offset));
    const Int<D> place = offset & Int<D>((1 << kSrgbBucketShift) - 1);
    return shift_right<kSrgbBucketShift>(bucket + place);
}

} // namespace scanout::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
