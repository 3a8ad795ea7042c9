// The planes of lanes' triangles as a light sees them, and what the shadow stages do with the share
// of light that is left.
#if defined(SCANOUT_SHADE_SHADOW_PLANE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_SHADOW_PLANE_INL_H
#undef SCANOUT_SHADE_SHADOW_PLANE_INL_H
#else
#define SCANOUT_SHADE_SHADOW_PLANE_INL_H
#endif

#include "shade/lane_triangles.h"
#include "shade/shadow.h"
#include "shade/stage.h"

#include "simd/entries-inl.h"

SIMD_BEGIN(scanout::shade::shadow)

// The triangles of a register of lanes, in view space.
struct Facing {
    F64 normal[3]; // towards the eye
    F64 corner[3][3];
    F64::DoubleMask lit; // the light stands on the side that the eye sees
};

// Where they come from: one for a whole run, or of each lane its own.
struct OfRun {
    const Primitive& t;
    SIMD_INLINE F32 facing(int c) const { return t.facing[c]; }
    SIMD_INLINE F32 position(int c, int k) const { return t.position[c][k]; }
};
struct OfLanes {
    const LaneTriangles& t;
    Entries<F32::Tag> entries; // of the register's lanes
    SIMD_INLINE F32 facing(int c) const { return entries.of(t.facing[c]); }
    SIMD_INLINE F32 position(int c, int k) const { return entries.of(t.position[c][k]); }
};

SIMD_INLINE F64 dot(const F64 (&a)[3], const F64 (&b)[3]) {
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

template <class Of>
SIMD_INLINE Facing facing_of(const Of& of, const FrameState& frame, const scene::ViewLight& light) {
    Facing f;
    F64 own[3];
    SIMD_FOR (int c = 0; c < 3; ++c)
        own[c] = to_f64(of.facing(c));
    SIMD_FOR (int r = 0; r < 3; ++r) {
        const float* row = frame.normal_matrix[r];
        f.normal[r] = dot({double{row[0]}, double{row[1]}, double{row[2]}}, own);
        SIMD_FOR (int k = 0; k < 3; ++k)
            f.corner[k][r] = to_f64(of.position(r, k));
    }
    const bool everywhere = light.kind == scene::LightKind::directional;
    const Vec3& from = everywhere ? light.towards : light.position;
    F64 way[3] = {double{from.x}, double{from.y}, double{from.z}};
    if (!everywhere) {
        SIMD_FOR (int c = 0; c < 3; ++c)
            way[c] = way[c] - f.corner[0][c];
    }
    f.lit = dot(f.normal, way) > F64(0.0);
    return f;
}

// share(light's index, first lane, end, facing, where the lanes' shares of light go): for every
// light that casts and every run, or every register of a run whose lanes have their own triangles.
// What faces away from the light gets none: it lies in its own shadow.
template <class Share>
SIMD_INLINE void shadow_lanes(Block& b, const FrameState& frame, Share share) {
    if (!b.lit || frame.shadows == nullptr) return;
    alignas(64) float left[kPaddedBlock];
    const std::size_t count = frame.lights.size();
    for (std::size_t k = 0; k < count; ++k) {
        if (!frame.shadows[k].casts) continue;
        const scene::ViewLight& light = frame.lights.data()[k];
        for (int i = b.runs > 0 ? b.run[b.runs - 1].first : 0; i < kPaddedBlock; ++i)
            left[i] = 0;
        for (const Run* run = b.run; run != b.run + b.runs; ++run) {
            const int end = run->first + run->count;
            const int step = run->primitive != nullptr ? run->count : kLanes;
            for (int i = run->first; i < end; i += step) {
                const auto of_lanes = [&]() SIMD_LAMBDA {
                    return OfLanes{*b.triangles, {b.triangles->of_lane + i, end - i}};
                };
                const Facing facing = run->primitive != nullptr
                                          ? facing_of(OfRun{*run->primitive}, frame, light)
                                          : facing_of(of_lanes(), frame, light);
                const std::uint32_t lit = bits(facing.lit);
                if (lit != 0) share(k, i, i + step, facing, left);
                if (lit == (1U << kLanes) - 1) continue;
                const F32 shown = to_f32(select(facing.lit, F64(1.0), F64(0.0)));
                for (int lane = i; lane < i + step; lane += kLanes)
                    store(select(shown > F32(0.5F), load<F32>(left + lane), F32(0.0F)),
                          left + lane);
            }
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
