// Where a face turns away from a light that its smooth normals still receive, the face alone would
// be dark, a single triangle among lit ones. There the surface is the round one that the normals
// mean, which lies above the face: shadows are asked for at a place lifted onto it, and the face
// itself is no occluder. The place is the mean of the point's images in the planes across the
// vertices' normals, as far as those lie above it. Hanika 2021.
#if defined(SCANOUT_SHADE_SHADOW_TERMINATOR_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_SHADOW_TERMINATOR_INL_H
#undef SCANOUT_SHADE_SHADOW_TERMINATOR_INL_H
#else
#define SCANOUT_SHADE_SHADOW_TERMINATOR_INL_H
#endif

#include "shade/stage.h"

#include "simd/vec3-inl.h"

SIMD_BEGIN(scanout::shade::shadow)

// A map has bent the normals: they say nothing of where the surface lies.
SIMD_INLINE bool bends_normals(const ShadingBlock& b) {
    return b.map[kNormalMap].texture != nullptr || b.map[kBumpMap].texture != nullptr;
}

// Of lanes whose faces turn away: which have a normal on the face's side that the light meets.
SIMD_INLINE Mask<F32::Tag> lit_as_round(const Vec3F32& normal, const Vec3F32& facing,
                                        const Vec3F32& towards) {
    return (dot(normal, towards) > F32(0.0F)) & (dot(normal, facing) > F32(0.0F));
}

// vertex, normal: of the lanes' triangles, unit, in view space. facing: of any length.
SIMD_INLINE Vec3F32 lifted(const Vec3F32& place, const Vec3F32 (&vertex)[3],
                           const Vec3F32 (&normal)[3], const Vec3F32& facing) {
    const F32 zero = 0.0F;
    Vec3F32 to[3];
    SIMD_FOR (int k = 0; k < 3; ++k)
        to[k] = vertex[k] - place;
    F32 area[3], sum = 0.0F; // opposite the vertices; up to a factor
    SIMD_FOR (int k = 0; k < 3; ++k) {
        area[k] = abs(dot(cross(to[(k + 1) % 3], to[(k + 2) % 3]), facing));
        sum = sum + area[k];
    }
    Vec3F32 lift = splat(zero);
    SIMD_FOR (int k = 0; k < 3; ++k)
        lift = lift + normal[k] * (area[k] * maximum(dot(to[k], normal[k]), zero));
    const auto usable = sum > F32(0x1p-100F);
    return place + lift * (F32(1.0F) / select(usable, sum, F32(0x1p100F)));
}

SIMD_END

#endif
