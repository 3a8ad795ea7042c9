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

#include "shade/shadow/terminator-inl.h"
#include "simd/entries-inl.h"
#include "simd/vec3-inl.h"

SIMD_BEGIN(scanout::shade::shadow)

// The triangles of a register of lanes, in view space.
struct Facing {
    Vec3F64 normal; // towards the eye
    Vec3F64 vertex[3];
    F64::DoubleMask lit; // the light stands on the side that the eye sees
    Mask<F32::Tag> back; // that is the back
};

// Where they come from: one for a whole run, or of each lane its own.
struct OfRun {
    const Primitive& t;
    SIMD_INLINE F32 facing(int c) const { return t.facing[c]; }
    SIMD_INLINE F32 position(int c, int k) const { return t.position[c][k]; }
    SIMD_INLINE F32 normal(int c, int k) const { return t.normal[c][k]; }
    SIMD_INLINE I32 back() const { return t.back ? 1 : 0; }
};
struct OfItems {
    const ShadingSetup& t;
    Entries<F32::Tag> entries; // of the register's lanes
    SIMD_INLINE F32 facing(int c) const { return entries.of(t.facing[c]); }
    SIMD_INLINE F32 position(int c, int k) const { return entries.of(t.position[c][k]); }
    SIMD_INLINE F32 normal(int c, int k) const { return entries.of(t.normal[c][k]); }
    SIMD_INLINE I32 back() const { return entries.of(t.back); }
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
    f.back = of.back() == I32(1);
    return f;
}

// Places of a block's items, in view space.
using Places = float[3][kPaddedBlock];

// Of a register of lanes whose faces turn away, some of which are lit as if they were round: which,
// the plane that stands for the face, and the place on it.
struct Round {
    Mask<F32::Tag> lit;
    Facing facing;
    Vec3F32 place;
};
template <class Of>
SIMD_INLINE Round round_of(const Of& of, const ShadingBlock& b, const FrameState& frame,
                           const Facing& face, Mask<F32::Tag> lit, int item) {
    Vec3F32 vertex[3], normal[3];
    SIMD_FOR (int k = 0; k < 3; ++k) {
        vertex[k] = {of.position(0, k), of.position(1, k), of.position(2, k)};
        const Vec3F32 given = {of.normal(0, k), of.normal(1, k), of.normal(2, k)};
        const Vec3F32 n = frame.vertex_normals ? given : transformed(frame.normal_matrix, given);
        const F32 size = length(n);
        normal[k] = normalised(n, size, size > F32(0x1p-60F), splat(F32(0.0F)));
    }
    const Vec3F32 own = {to_f32(face.normal.x), to_f32(face.normal.y), to_f32(face.normal.z)};
    const Vec3F32 place = lifted(load_vec3<Vec3F32>(b.position, item), vertex, normal, own);
    const Vec3F32 n = load_vec3<Vec3F32>(b.normal, item);
    Round round{lit, {{to_f64(n.x), to_f64(n.y), to_f64(n.z)}, {}, {}, face.back}, place};
    SIMD_FOR (int k = 0; k < 3; ++k)
        round.facing.vertex[k] = {to_f64(place.x), to_f64(place.y), to_f64(place.z)};
    round.facing.lit = to_f64(select(lit, F32(1.0F), F32(0.0F))) > F64(0.5);
    return round;
}

// store_visibility(light's index, first lane, end, facing, places, visible fractions of the light):
// for every light that casts and every run, or every register of a run whose lanes have their own
// triangles; and for every register of what is lit as if it were round. What else faces away from
// the light gets none: it lies in its own shadow.
template <class StoreVisibility>
class ShadowLanes {
public:
    SIMD_INLINE ShadowLanes(ShadingBlock& b, const FrameState& frame,
                            const StoreVisibility& store_visibility)
        : b_(b), frame_(frame), store_visibility_(store_visibility), bent_(bends_normals(b)) {}

    SIMD_INLINE void light(std::size_t k) {
        for (int i = b_.runs > 0 ? b_.run[b_.runs - 1].first : 0; i < kPaddedBlock; ++i)
            visibility_[i] = 0;
        for (const Run* run = b_.run; run != b_.run + b_.runs; ++run) {
            const int end = run->first + run->count;
            if (run->primitive != nullptr) {
                lanes(k, OfRun{*run->primitive}, run->first, end);
                continue;
            }
            for (int i = run->first; i < end; i += kLanes)
                lanes(k, OfItems{*b_.triangles, {b_.triangles->triangle_of + i, end - i}}, i,
                      i + kLanes);
        }
        BlockLight& lanes = b_.light.data()[k];
        for (int i = 0; i < b_.count; i += kLanes) {
            const F32 s = load<F32>(visibility_ + i);
            store_vec3(load_vec3<Vec3F32>(lanes.colour, i) * s, lanes.colour, i);
        }
    }

private:
    // From `first` on, whose triangles `of` has.
    template <class Of>
    SIMD_INLINE void lanes(std::size_t k, const Of& of, int first, int end) {
        const Facing facing = facing_of(of, frame_, frame_.lights.data()[k]);
        const std::uint32_t lit = bits(facing.lit);
        if (lit != 0) store_visibility_(k, first, end, facing, b_.position, visibility_);
        if (lit == (1U << kLanes) - 1) return;
        const auto lit_side =
            to_f32(select(facing.lit, F64(1.0), F64(0.0))) > F32(0.5F); // of the face
        const Vec3F32 own = {to_f32(facing.normal.x), to_f32(facing.normal.y),
                             to_f32(facing.normal.z)};
        for (int i = first; i < end; i += kLanes) {
            const F32 of_face = select(lit_side, load<F32>(visibility_ + i), F32(0.0F));
            store(of_face, visibility_ + i);
            if (bent_) continue;
            const auto round = select(lit_side, F32(0.0F), F32(1.0F)) > F32(0.5F) &
                               lit_as_round(load_vec3<Vec3F32>(b_.normal, i), own,
                                            load_vec3<Vec3F32>(b_.light.data()[k].towards, i));
            if (!any(round)) continue;
            const Round r = round_of(of, b_, frame_, facing, round, i);
            store_vec3(r.place, places_, i);
            store_visibility_(k, i, i + kLanes, r.facing, places_, visibility_);
            store(select(round, load<F32>(visibility_ + i), of_face), visibility_ + i);
        }
    }

    ShadingBlock& b_;
    const FrameState& frame_;
    const StoreVisibility& store_visibility_;
    bool bent_;
    alignas(64) float visibility_[kPaddedBlock];
    alignas(64) Places places_;
};

template <class StoreVisibility>
SIMD_INLINE void shadow_lanes(ShadingBlock& b, const FrameState& frame,
                              const StoreVisibility& store_visibility) {
    if (!b.lit || frame.shadows == nullptr) return;
    ShadowLanes<StoreVisibility> lanes(b, frame, store_visibility);
    const std::size_t count = frame.lights.size();
    for (std::size_t k = 0; k < count; ++k)
        if (frame.shadows[k].casts) lanes.light(k);
}

SIMD_END

#endif
