// What a sample shows of a primitive that covers it. Included once for every SIMD target.
#if defined(SCANOUT_RASTER_SHOW_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_RASTER_SHOW_INL_H
#undef SCANOUT_RASTER_SHOW_INL_H
#else
#define SCANOUT_RASTER_SHOW_INL_H
#endif

#include "raster/visible_rule.h"

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

// VisibleRule::kept.
HWY_INLINE F32x8 kept(F32x8 z, const VisibleRule& rule) {
    if (!rule.standard) return z;
    const F64x8 turned = F64x8(1.0) - to_f64(z), whole = 0x1.8p52;
    const F64x8 stored = rule.steps > 0
                             ? ((turned * F64x8(rule.steps) + whole) - whole) / F64x8(rule.steps)
                             : to_f64(to_f32(turned));
    return to_f32(F64x8(1.0) - stored);
}

// The same by another rule than the usual one.
HWY_INLINE void show_by(const VisibleRule& rule, MaskX8 inside, F32x8 depth_here,
                        std::uint32_t primitive, float* depth, std::uint32_t* id, I32x8& drawn) {
    const F32x8 z = kept(depth_here, rule), old = load<F32x8>(depth);
    const I32x8 old_id = load<I32x8>(id), new_id = static_cast<std::int32_t>(primitive);
    const I32x8 half = INT32_MIN, mine = new_id + half, others = old_id + half;
    const MaskX8 empty = old_id == I32x8(-1), tie = z == old;
    const MaskX8 lower = mine < others;
    const MaskX8 higher = others < mine;
    MaskX8 pass = mine < mine; // none
    switch (rule.test) {
    case DepthTest::equal:
        pass = (!empty) & tie & higher;
        break;
    case DepthTest::always:
        pass = empty | higher;
        break;
    case DepthTest::never:
        break;
    case DepthTest::less:
        pass = empty | (z < old) | (tie & lower);
        break;
    case DepthTest::less_equal:
        pass = empty | (z < old) | (tie & higher);
        break;
    case DepthTest::greater_equal:
        pass = empty | (z > old) | (tie & higher);
        break;
    case DepthTest::greater:
        pass = (z > old) | (tie & lower);
        break;
    }
    pass = pass & inside;
    store(select(pass, z, old), depth);
    store(select(pass, new_id, old_id), id);
    drawn = select(pass, I32x8(-1), drawn);
}

SIMD_END

#endif
