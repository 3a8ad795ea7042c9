// The plane of a run's triangle as a light sees it, and what the shadow stages do with the share of
// light that is left.
#if defined(SCANOUT_SHADE_SHADOW_PLANE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_SHADOW_PLANE_INL_H
#undef SCANOUT_SHADE_SHADOW_PLANE_INL_H
#else
#define SCANOUT_SHADE_SHADOW_PLANE_INL_H
#endif

#include "shade/shadow.h"
#include "shade/stage.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade::shadow)

struct Facing {
    double normal[3];    // of the triangle, towards the eye; view space
    double corner[3][3]; // view space
    bool lit;            // the light stands on the side that the eye sees
};

HWY_INLINE double dot(const double (&a)[3], const double (&b)[3]) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

HWY_INLINE Facing facing_of(const Primitive& t, const FrameState& frame,
                            const scene::ViewLight& light) {
    Facing f{};
    for (int r = 0; r < 3; ++r) {
        const float* row = frame.normal_matrix[r];
        const double way[3] = {t.facing[0], t.facing[1], t.facing[2]};
        const double turned[3] = {row[0], row[1], row[2]};
        f.normal[r] = dot(turned, way);
        for (int k = 0; k < 3; ++k)
            f.corner[k][r] = t.position[r][k];
    }
    const bool everywhere = light.kind == scene::LightKind::directional;
    const Vec3& from = everywhere ? light.towards : light.position;
    double way[3] = {from.x, from.y, from.z};
    if (!everywhere)
        for (int c = 0; c < 3; ++c)
            way[c] -= f.corner[0][c];
    f.lit = dot(f.normal, way) > 0;
    return f;
}

// share(light's index, run, facing, where the lanes' shares of light go): for every light that
// casts and every run. What faces away from the light gets none: it lies in its own shadow.
template <class Share>
HWY_INLINE void shadow_lanes(Block& b, const FrameState& frame, Share share) {
    if (!b.lit || frame.shadows == nullptr) return;
    alignas(64) float left[kRoom];
    const std::size_t count = frame.lights.size();
    for (std::size_t k = 0; k < count; ++k) {
        if (!frame.shadows[k].casts) continue;
        for (int i = b.runs > 0 ? b.run[b.runs - 1].first : 0; i < kRoom; ++i)
            left[i] = 0;
        for (const Run* run = b.run; run != b.run + b.runs; ++run) {
            const Facing facing = facing_of(*run->primitive, frame, frame.lights.data()[k]);
            if (facing.lit)
                share(k, *run, facing, left);
            else
                for (int i = run->first; i < run->first + run->count; ++i)
                    left[i] = 0;
        }
        LightLanes& lanes = b.light.data()[k];
        for (int i = 0; i < b.count; i += kLanes) {
            const F32 s = load<F32>(left + i);
            for (int c = 0; c < 3; ++c)
                store(load<F32>(lanes.colour[c] + i) * s, lanes.colour[c] + i);
        }
    }
}

SIMD_END

#endif
