// The part that all interpolations share: a rung computes the weights of a triangle's vertices at
// each lane, and this file mixes normals, uv and colours by them. A result never leaves the range
// of its vertices, not even by rounding: u just below 0 would show the texel at the other end of
// the texture (HARD-CASES 34).
#if defined(SCANOUT_SHADE_INTERPOLATE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_INTERPOLATE_INL_H
#undef SCANOUT_SHADE_INTERPOLATE_INL_H
#else
#define SCANOUT_SHADE_INTERPOLATE_INL_H
#endif

#include "shade/setup/shading_setup.h"

#include "shade/interpolate/large_uv-inl.h"
#include "shade/interpolate/weights-inl.h"
#include "shade/setup/footprint-inl.h"
#include "simd/entries-inl.h"
#include "simd/vec3-inl.h"

SIMD_BEGIN(scanout::shade::interpolate)

// Vertex attributes mixed at a register of lanes: of one triangle, or of each lane's own triangle.
struct OfRun {
    const Primitive& t;
    Spread of_normal[3];
    SIMD_INLINE explicit OfRun(const Primitive& of)
        : t(of), of_normal{spread_of(of.normal[0]), spread_of(of.normal[1]),
                           spread_of(of.normal[2])} {}
    SIMD_INLINE F32 normal(const Weights& w, int c) const { return mix(w, of_normal[c]); }
    SIMD_INLINE F32 uv(const Weights& w, int c) const { return mix(w, t.uv[c]); }
    SIMD_INLINE F32 colour(const Weights& w, int c) const { return mix(w, t.colour[c]); }
    SIMD_INLINE F32 position(const Weights& w, int c) const { return mix(w, t.position[c]); }
};
struct OfItems {
    const ShadingSetup& t;
    Entries<F32::Tag> entries; // of the register's lanes
    SIMD_INLINE F32 mixed(const Weights& w, const float (&vertex)[3][kPaddedBlock]) const {
        return mix(w, entries.of(vertex[0]), entries.of(vertex[1]), entries.of(vertex[2]));
    }
    SIMD_INLINE F32 normal(const Weights& w, int c) const { return mixed(w, t.normal[c]); }
    SIMD_INLINE F32 uv(const Weights& w, int c) const { return mixed(w, t.uv[c]); }
    SIMD_INLINE F32 colour(const Weights& w, int c) const { return mixed(w, t.colour[c]); }
    SIMD_INLINE F32 position(const Weights& w, int c) const { return mixed(w, t.position[c]); }
};

// How a frame needs its normals. Tested for every register of lanes: as a template argument it
// compiled six versions of every rung for every target, and saved no more than a branch.
enum class Normals { none, unit, raw };

// Unit normals in view space.
SIMD_INLINE Vec3F32 to_view(const FrameState& frame, const Vec3F32& normal) {
    const Vec3F32 turned = transformed(frame.normal_matrix, normal);
    const F32 size = length(turned), zero = 0.0F, one = 1.0F;
    const auto usable = size > F32(0x1p-60F); // opposite normals can cancel: then face the eye
    return normalised(turned, size, usable, Vec3F32{zero, zero, one});
}

// Makes the mixed normals of lanes first to end unit normals in view space, across runs: the square
// root and the division of a register cost most of it, and few runs fill their last register.
SIMD_INLINE void lanes_to_view(ShadingBlock& b, const FrameState& frame, int first, int end) {
    for (int i = first; i < end; i += kLanes)
        store_vec3(to_view(frame, load_vec3<Vec3F32>(b.normal, i)), b.normal, i);
}

// The attributes that a block needs.
struct Wanted {
    Normals normal;
    bool uv, colour, position;
    float kd[3];
    SIMD_INLINE bool any() const { return normal != Normals::none || uv || colour || position; }
};
SIMD_INLINE Wanted wanted(const ShadingBlock& b, const FrameState& frame) {
    return {!frame.attributes.normal ? Normals::none
            : frame.vertex_normals   ? Normals::raw
                                     : Normals::unit,
            wants_uv(b, frame) && !frame.mapped,
            frame.attributes.colour,
            frame.attributes.position,
            {b.material->diffuse.x, b.material->diffuse.y, b.material->diffuse.z}};
}

// Stores one register of lanes, from lane i on. Normals stay as mixed.
template <class Of>
SIMD_INLINE void store_attributes(ShadingBlock& b, const Wanted& want, const Of& of,
                                  const Weights& w, int i) {
    if (want.normal != Normals::none)
        SIMD_FOR (int c = 0; c < 3; ++c)
            store(of.normal(w, c), b.normal[c] + i);
    if (want.uv) {
        store(of.uv(w, 0), b.u + i);
        store(of.uv(w, 1), b.v + i);
    }
    if (want.position)
        SIMD_FOR (int c = 0; c < 3; ++c)
            store(of.position(w, c), b.position[c] + i);
    if (want.colour)
        SIMD_FOR (int c = 0; c < 3; ++c)
            store(F32(want.kd[c]) * of.colour(w, c), b.albedo[c] + i);
}

// Do all vertices have the same normal, to the bit? Then so does every lane, since no rung's
// weights leave the range of the vertices. Saves 27 % of the instructions of a building, 21 % of
// those of the Cornell box.
SIMD_INLINE bool is_flat(const Primitive& t) {
    std::int32_t bits[3][3];
    static_assert(sizeof bits == sizeof t.normal);
    __builtin_memcpy(bits, t.normal, sizeof bits);
    return bits[0][0] == bits[0][1] && bits[0][0] == bits[0][2] && //
           bits[1][0] == bits[1][1] && bits[1][0] == bits[1][2] && //
           bits[2][0] == bits[2][1] && bits[2][0] == bits[2][2];
}
SIMD_INLINE void flat_normals(ShadingBlock& b, const FrameState& frame, const Wanted& want,
                              const Run& run) {
    const Weights first = {F32(0.0F), F32(0.0F), {run.first, run.count}};
    const OfRun of(*run.primitive);
    const Vec3F32 mixed = {of.normal(first, 0), of.normal(first, 1), of.normal(first, 2)};
    const Vec3F32 n = want.normal != Normals::raw ? to_view(frame, mixed) : mixed;
    for (int i = run.first; i < run.first + run.count; i += kLanes)
        store_vec3(n, b.normal, i);
}

// Stores the material's own albedo.
SIMD_INLINE void store_albedo(ShadingBlock& b, const Wanted& want) {
    const F32 red = want.kd[0], green = want.kd[1], blue = want.kd[2];
    for (int i = 0; i < b.count; i += kLanes) {
        store(red, b.albedo[0] + i);
        store(green, b.albedo[1] + i);
        store(blue, b.albedo[2] + i);
    }
}

// Interpolates exactly, at every lane of a run.
SIMD_INLINE void perspective_lanes(ShadingBlock& b, const Wanted& want, const Run& run) {
    const Primitive& t = *run.primitive;
    const OfRun of(t);
    for (int i = run.first; i < run.first + run.count; i += kLanes)
        store_attributes(
            b, want, of,
            weights(t, load<I32>(b.x + i), load<I32>(b.y + i), {i, run.first + run.count - i}), i);
}

// The same at lanes with triangles of their own.
SIMD_INLINE void perspective_own(ShadingBlock& b, const Wanted& want, const Run& run) {
    const ShadingSetup& t = *b.triangles;
    for (int i = run.first; i < run.first + run.count; i += kLanes) {
        const Live live{i, run.first + run.count - i};
        store_attributes(b, want, OfItems{t, {t.triangle_of + i, live.count}},
                         weights_of(load<F32>(t.weight[0] + i), load<F32>(t.weight[1] + i),
                                    load<F32>(t.weight[2] + i), live),
                         i);
    }
}

// Runs over all runs of a block; Rung::lanes fills the lanes of one.
template <class Rung>
SIMD_INLINE void run_rung(ShadingBlock& b, const FrameState& frame) {
    if (!b.lit) return;
    const Wanted want = wanted(b, frame);
    if (!want.colour) store_albedo(b, want);
    Wanted rest = want; // of flat triangles
    rest.normal = Normals::none;
    const bool shades = want.normal != Normals::none;
    int viewed = 0; // lanes whose normals are done
    const auto view_until = [&](int end) SIMD_LAMBDA {
        if (shades && want.normal != Normals::raw) lanes_to_view(b, frame, viewed, end);
    };
    for (const Run* run = b.run; run != b.run + b.runs; ++run) {
        const bool flat = shades && run->primitive != nullptr && is_flat(*run->primitive);
        if (flat) {
            view_until(run->first);
            flat_normals(b, frame, want, *run);
            viewed = run->first + run->count;
        }
        if (!flat || rest.any()) Rung::lanes(b, flat ? rest : want, *run);
    }
    view_until(b.count);
    if (Rung::kExact && want.uv && frame.exact_uv) write_large_uv(b);
    // The derivatives of u and v are exact on every rung.
    if (want.uv && frame.attributes.footprint) texture::HWY_NAMESPACE::write_slopes(b);
}

SIMD_END

#endif
