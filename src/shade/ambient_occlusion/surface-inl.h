// What a register of pixels of a SurfaceImage shows.
#if defined(SCANOUT_SHADE_AMBIENT_OCCLUSION_SURFACE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_AMBIENT_OCCLUSION_SURFACE_INL_H
#undef SCANOUT_SHADE_AMBIENT_OCCLUSION_SURFACE_INL_H
#else
#define SCANOUT_SHADE_AMBIENT_OCCLUSION_SURFACE_INL_H
#endif

#include "shade/ambient_occlusion.h"

#include "simd/vec3-inl.h"

SIMD_BEGIN(scanout::shade::ambient_occlusion)

// The place in view space that the pixel (x, y) shows at a distance.
template <bool kOrthographic>
SIMD_INLINE Vec3F32 place_at(const SurfaceImage& s, F32 x, F32 y, F32 distance) {
    const F32 across = F32(s.offset_x) + F32(s.scale_x) * (x + F32(0.5F)),
              down = F32(s.offset_y) + F32(s.scale_y) * (y + F32(0.5F));
    const F32 away = F32(0.0F) - distance;
    if constexpr (kOrthographic) return {across, down, away};
    return {across * distance, down * distance, away};
}

struct Seen {
    Vec3F32 place, eye, normal; // eye, normal: unit; from the place, and on the side of the eye
};

// Of the pixels from (x, y) on, a register's worth.
template <bool kOrthographic>
SIMD_INLINE Seen seen_at(const SurfaceImage& s, F32 x, F32 y, std::ptrdiff_t at) {
    Seen seen;
    seen.place = place_at<kOrthographic>(s, x, y, load<F32>(s.distance + at));
    if constexpr (kOrthographic) {
        seen.eye = {F32(0.0F), F32(0.0F), F32(1.0F)};
    } else {
        const Vec3F32 towards = splat(F32(0.0F)) - seen.place;
        seen.eye = towards * (F32(1.0F) / length(towards)); // nothing lies before the near plane
    }
    const I32 first = load<I32>(s.triangle + at) * I32(3);
    const Vec3F32 own = {gather(s.normal, first), gather(s.normal + 1, first),
                         gather(s.normal + 2, first)};
    const auto row = [&](int r) SIMD_LAMBDA {
        const float(&m)[3] = s.normal_matrix[r];
        return (F32(m[0]) * own.x + F32(m[1]) * own.y) + F32(m[2]) * own.z;
    };
    const Vec3F32 turned = {row(0), row(1), row(2)};
    const F32 size = length(turned);
    const Vec3F32 unit = normalised(turned, size, size > F32(0x1p-40F), seen.eye);
    seen.normal = select(dot(unit, seen.eye) < F32(0.0F), splat(F32(0.0F)) - unit, unit);
    return seen;
}

// A pixel's width there.
template <bool kOrthographic>
SIMD_INLINE F32 footprint(const SurfaceImage& s, const Seen& seen) {
    if constexpr (kOrthographic) return F32(s.scale_x);
    return F32(s.scale_x) * (F32(0.0F) - seen.place.z);
}

SIMD_END

#endif
