// The planes of lanes' triangles as a light sees them, and what the shadow stages do with the share
// of light that is left.
#if defined(SCANOUT_SHADE_SHADOW_PLANE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_SHADOW_PLANE_INL_H
#undef SCANOUT_SHADE_SHADOW_PLANE_INL_H
#else
#define SCANOUT_SHADE_SHADOW_PLANE_INL_H
#endif

#include "shade/setup/shading_setup.h"
#include "shade/shadow.h"
#include "shade/stage.h"

#include "simd/entries-inl.h"
#include "simd/vec3-inl.h"

SIMD_BEGIN(scanout::shade::shadow)

// The triangles of a register of lanes, in view space.
struct Facing {
    Vec3F64 normal; // towards the eye
    Vec3F64 vertex[3];
    F64::DoubleMask lit; // the light stands on the side that the eye sees
};

// Where they come from: one for a whole run, or of each lane its own.
struct OfRun {
    const Primitive& t;
    SIMD_INLINE F32 facing(int c) const { return t.facing[c]; }
    SIMD_INLINE F32 position(int c, int k) const { return t.position[c][k]; }
};
struct OfItems {
    const ShadingSetup& t;
    Entries<F32::Tag> entries; // of the register's lanes
    SIMD_INLINE F32 facing(int c) const { return entries.of(t.facing[c]); }
    SIMD_INLINE F32 position(int c, int k) const { return entries.of(t.position[c][k]); }
};

template <class Of>
SIMD_INLINE Facing facing_of(const Of& of, const FrameState& frame, const scene::ViewLight& light) {
    Facing f;
    f.normal = transformed(frame.normal_matrix, Vec3F64{to_f64(of.facing(0)), to_f64(of.facing(1)),
                                                        to_f64(of.facing(2))});
    SIMD_FOR (int k = 0; k < 3; ++k)
        f.vertex[k] = {to_f64(of.position(0, k)), to_f64(of.position(1, k)),
                       to_f64(of.position(2, k))};
    const bool parallel = light.kind == scene::LightKind::directional;
    Vec3F64 way = everywhere<Vec3F64>(parallel ? light.towards : light.position);
    if (!parallel) way = way - f.vertex[0];
    f.lit = dot(f.normal, way) > F64(0.0);
    return f;
}

// store_visibility(light's index, first lane, end, facing, visible fractions of the light): for
// every light that casts and every run, or every register of a run whose lanes have their own
// triangles. What faces away from the light gets none: it lies in its own shadow.
template <class StoreVisibility>
SIMD_INLINE void shadow_lanes(ShadingBlock& b, const FrameState& frame,
                              StoreVisibility store_visibility) {
    if (!b.lit || frame.shadows == nullptr) return;
    alignas(64) float visibility[kPaddedBlock];
    const std::size_t count = frame.lights.size();
    for (std::size_t k = 0; k < count; ++k) {
        if (!frame.shadows[k].casts) continue;
        const scene::ViewLight& light = frame.lights.data()[k];
        for (int i = b.runs > 0 ? b.run[b.runs - 1].first : 0; i < kPaddedBlock; ++i)
            visibility[i] = 0;
        for (const Run* run = b.run; run != b.run + b.runs; ++run) {
            const int end = run->first + run->count;
            const int step = run->primitive != nullptr ? run->count : kLanes;
            for (int i = run->first; i < end; i += step) {
                const auto of_items = [&]() SIMD_LAMBDA {
                    return OfItems{*b.triangles, {b.triangles->triangle_of + i, end - i}};
                };
                const Facing facing = run->primitive != nullptr
                                          ? facing_of(OfRun{*run->primitive}, frame, light)
                                          : facing_of(of_items(), frame, light);
                const std::uint32_t lit = bits(facing.lit);
                if (lit != 0) store_visibility(k, i, i + step, facing, visibility);
                if (lit == (1U << kLanes) - 1) continue;
                const F32 lit_side = to_f32(select(facing.lit, F64(1.0), F64(0.0)));
                for (int item = i; item < i + step; item += kLanes)
                    store(select(lit_side > F32(0.5F), load<F32>(visibility + item), F32(0.0F)),
                          visibility + item);
            }
        }
        BlockLight& lanes = b.light.data()[k];
        for (int i = 0; i < b.count; i += kLanes) {
            const F32 s = load<F32>(visibility + i);
            store_vec3(load_vec3<Vec3F32>(lanes.colour, i) * s, lanes.colour, i);
        }
    }
}

SIMD_END

#endif
