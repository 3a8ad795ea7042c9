// What the interpolations share: a rung says how the weights of a triangle's vertices come about at
// a lane; normals, uv and colours are mixed by them. A result never leaves the range of its
// vertices, not even by rounding: u just below 0 would show the texel at the other end of the
// texture (HARD-CASES 34).
#if defined(SCANOUT_SHADE_INTERPOLATE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_INTERPOLATE_INL_H
#undef SCANOUT_SHADE_INTERPOLATE_INL_H
#else
#define SCANOUT_SHADE_INTERPOLATE_INL_H
#endif

#include "shade/lane_triangles.h"

#include "shade/footprint-inl.h"
#include "shade/interpolate/weights-inl.h"

SIMD_BEGIN(scanout::shade::interpolate)

// What vertices carry, mixed at a register of lanes: of one triangle, or of each lane's own.
struct OfRun {
    const Primitive& t;
    HWY_INLINE F32x8 normal(const Weights& w, int c) const { return mix(w, t.normal[c]); }
    HWY_INLINE F32x8 uv(const Weights& w, int c) const { return mix(w, t.uv[c]); }
    HWY_INLINE F32x8 colour(const Weights& w, int c) const { return mix(w, t.colour[c]); }
    HWY_INLINE F32x8 position(const Weights& w, int c) const { return mix(w, t.position[c]); }
    HWY_INLINE F32x8 facing(int c) const { return t.facing[c]; }
};
struct OfLanes {
    const LaneTriangles& t;
    int lane; // the register's first
    HWY_INLINE F32x8 mixed(const Weights& w, const float (&vertex)[3][kRoom]) const {
        return mix(w, load<F32x8>(vertex[0] + lane), load<F32x8>(vertex[1] + lane),
                   load<F32x8>(vertex[2] + lane));
    }
    HWY_INLINE F32x8 normal(const Weights& w, int c) const {
        const F32x8 side = load<F32x8>(t.side + lane);
        const auto& vertex = t.normal[c];
        return mix(w, load<F32x8>(vertex[0] + lane) * side, load<F32x8>(vertex[1] + lane) * side,
                   load<F32x8>(vertex[2] + lane) * side);
    }
    HWY_INLINE F32x8 uv(const Weights& w, int c) const { return mixed(w, t.uv[c]); }
    HWY_INLINE F32x8 colour(const Weights& w, int c) const { return mixed(w, t.colour[c]); }
    HWY_INLINE F32x8 position(const Weights& w, int c) const { return mixed(w, t.position[c]); }
    HWY_INLINE F32x8 facing(int c) const { return load<F32x8>(t.facing[c] + lane); }
};

// How a frame wants its normals. Asked for every register of lanes: as a template's argument it
// made six of every rung, on every target, and saved no more than a branch.
enum class Normals { none, turned, unit, raw };

// In view space. turned: the side that the eye sees is lit, whichever way the file wound it or its
// normals. raw: as the vertices' unit normals mix, shorter between them.
template <class Of>
HWY_INLINE void normals(Normals wanted, const Of& of, const FrameState& frame, const Weights& w,
                        float* to_x, float* to_y, float* to_z) {
    F32x8 n[3] = {of.normal(w, 0), of.normal(w, 1), of.normal(w, 2)};
    if (wanted == Normals::raw) {
        store(n[0], to_x);
        store(n[1], to_y);
        store(n[2], to_z);
        return;
    }
    if (wanted == Normals::turned) {
        const F32x8 side = (n[0] * of.facing(0) + n[1] * of.facing(1)) + n[2] * of.facing(2);
        const F32x8 sign = select(side < F32x8(0.0F), F32x8(-1.0F), F32x8(1.0F));
        SIMD_UNROLL
        for (F32x8& component : n)
            component = component * sign;
    }
    const auto row = [&](int r) {
        const auto& m = frame.normal_matrix[r];
        return (F32x8(m[0]) * n[0] + F32x8(m[1]) * n[1]) + F32x8(m[2]) * n[2];
    };
    const F32x8 x = row(0), y = row(1), z = row(2);
    const F32x8 length = sqrt((x * x + y * y) + z * z);
    const auto usable = length > F32x8(0x1p-60F); // opposite normals can cancel: then face the eye
    const F32x8 scale = F32x8(1.0F) / select(usable, length, F32x8(1.0F));
    store(select(usable, x * scale, F32x8(0.0F)), to_x);
    store(select(usable, y * scale, F32x8(0.0F)), to_y);
    store(select(usable, z * scale, F32x8(1.0F)), to_z);
}

// Which attributes a block wants.
struct Wanted {
    Normals normal;
    bool uv, colour, position;
    float kd[3];
};
HWY_INLINE Wanted wanted(const Block& b, const FrameState& frame) {
    return {!frame.attributes.normal    ? Normals::none
            : frame.corner_normals      ? Normals::raw
            : frame.sides == Sides::eye ? Normals::turned
                                        : Normals::unit,
            wants_uv(b, frame) && !frame.mapped,
            frame.attributes.colour,
            frame.attributes.position,
            {b.material->diffuse.x, b.material->diffuse.y, b.material->diffuse.z}};
}

// One register of lanes from lane i on.
template <class Of>
HWY_INLINE void put(Block& b, const FrameState& frame, const Wanted& want, const Of& of,
                    const Weights& w, int i) {
    if (want.normal != Normals::none)
        normals(want.normal, of, frame, w, b.normal[0] + i, b.normal[1] + i, b.normal[2] + i);
    if (want.uv) {
        store(of.uv(w, 0), b.u + i);
        store(of.uv(w, 1), b.v + i);
    }
    if (want.position) SIMD_UNROLL
    for (int c = 0; c < 3; ++c)
        store(of.position(w, c), b.position[c] + i);
    SIMD_UNROLL
    for (int c = 0; c < 3; ++c) {
        const F32x8 own = want.colour ? of.colour(w, c) : F32x8(1.0F);
        store(F32x8(want.kd[c]) * own, b.albedo[c] + i);
    }
}

// Exactly, at every lane of a run.
HWY_INLINE void perspective_lanes(Block& b, const FrameState& frame, const Wanted& want,
                                  const Run& run) {
    const Primitive& t = *run.primitive;
    for (int i = run.first; i < run.first + run.count; i += kLanesX8)
        put(b, frame, want, OfRun{t},
            weights(t, load<I32x8>(b.x + i), load<I32x8>(b.y + i), {i, run.first + run.count - i}),
            i);
}

// The same at lanes that have triangles of their own.
HWY_INLINE void perspective_own(Block& b, const FrameState& frame, const Wanted& want,
                                const Run& run) {
    const LaneTriangles& t = *b.triangles;
    for (int i = run.first; i < run.first + run.count; i += kLanesX8)
        put(b, frame, want, OfLanes{t, i},
            weights_of(load<F32x8>(t.weight[0] + i), load<F32x8>(t.weight[1] + i),
                       load<F32x8>(t.weight[2] + i), {i, run.first + run.count - i}),
            i);
}

// All runs of a block; Rung::lanes fills those of one.
template <class Rung>
HWY_INLINE void run_rung(Block& b, const FrameState& frame) {
    if (!b.lit) return;
    const Wanted want = wanted(b, frame);
    for (const Run* run = b.run; run != b.run + b.runs; ++run)
        Rung::lanes(b, frame, want, *run);
    // How u and v change is exact whatever the rung.
    if (want.uv && frame.attributes.footprint) texture::HWY_NAMESPACE::write_slopes(b);
}

SIMD_END

#endif
