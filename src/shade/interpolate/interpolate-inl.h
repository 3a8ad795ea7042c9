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

#include "shade/footprint-inl.h"
#include "shade/interpolate/weights-inl.h"

SIMD_BEGIN(scanout::shade::interpolate)

// How a frame wants its normals.
enum class Normals { turned, unit, raw };

// In view space. turned: the side that the eye sees is lit, whichever way the file wound it or its
// normals. raw: as the vertices' unit normals mix, shorter between them.
template <Normals kNormals>
HWY_INLINE void normals(const Primitive& t, const FrameState& frame, const Weights& w, float* to_x,
                        float* to_y, float* to_z) {
    F32x8 n[3] = {mix(w, t.normal[0]), mix(w, t.normal[1]), mix(w, t.normal[2])};
    if constexpr (kNormals == Normals::raw) {
        store(n[0], to_x);
        store(n[1], to_y);
        store(n[2], to_z);
        return;
    }
    if constexpr (kNormals == Normals::turned) {
        const F32x8 side =
            (n[0] * F32x8(t.facing[0]) + n[1] * F32x8(t.facing[1])) + n[2] * F32x8(t.facing[2]);
        const F32x8 sign = select(side < F32x8(0.0F), F32x8(-1.0F), F32x8(1.0F));
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
    bool normal, uv, colour;
    float kd[3];
};
HWY_INLINE Wanted wanted(const Block& b, const FrameState& frame) {
    return {frame.attributes.normal,
            wants_uv(b, frame) && !frame.mapped,
            frame.attributes.colour,
            {b.material->diffuse.x, b.material->diffuse.y, b.material->diffuse.z}};
}

// What the frame decides once for all its lanes.
template <Normals kWantedNormals, bool kWantsPosition>
struct FormOf {
    static constexpr Normals kNormals = kWantedNormals;
    static constexpr bool kPosition = kWantsPosition;
};

// One register of lanes from lane i on.
template <class Form>
HWY_INLINE void put(Block& b, const FrameState& frame, const Wanted& want, const Primitive& t,
                    const Weights& w, int i) {
    if (want.normal)
        normals<Form::kNormals>(t, frame, w, b.normal[0] + i, b.normal[1] + i, b.normal[2] + i);
    if (want.uv) {
        store(mix(w, t.uv[0]), b.u + i);
        store(mix(w, t.uv[1]), b.v + i);
    }
    if constexpr (Form::kPosition)
        for (int c = 0; c < 3; ++c)
            store(mix(w, t.position[c]), b.position[c] + i);
    for (int c = 0; c < 3; ++c) {
        const F32x8 own = want.colour ? mix(w, t.colour[c]) : F32x8(1.0F);
        store(F32x8(want.kd[c]) * own, b.albedo[c] + i);
    }
}

// Exactly, at every lane of a run.
template <class Form>
HWY_INLINE void perspective_lanes(Block& b, const FrameState& frame, const Wanted& want,
                                  const Run& run) {
    const Primitive& t = *run.primitive;
    for (int i = run.first; i < run.first + run.count; i += kLanesX8)
        put<Form>(b, frame, want, t,
                  weights(t, to_f64(load<I32x8>(b.x + i)), to_f64(load<I32x8>(b.y + i))), i);
}

template <class Rung, class Form>
HWY_INLINE void run_form(Block& b, const FrameState& frame) {
    const Wanted want = wanted(b, frame);
    for (const Run* run = b.run; run != b.run + b.runs; ++run)
        Rung::template lanes<Form>(b, frame, want, *run);
}

template <class Rung, Normals kNormals>
HWY_INLINE void run_normals(Block& b, const FrameState& frame) {
    if (frame.attributes.position)
        run_form<Rung, FormOf<kNormals, true>>(b, frame);
    else
        run_form<Rung, FormOf<kNormals, false>>(b, frame);
}

// All runs of a block; Rung::lanes<Form> fills those of one.
template <class Rung>
HWY_INLINE void run_rung(Block& b, const FrameState& frame) {
    if (!b.lit) return;
    if (frame.corner_normals)
        run_normals<Rung, Normals::raw>(b, frame);
    else if (frame.sides == Sides::eye)
        run_normals<Rung, Normals::turned>(b, frame);
    else
        run_normals<Rung, Normals::unit>(b, frame);
    // How u and v change is exact whatever the rung.
    if (frame.attributes.footprint && !frame.mapped && wants_uv(b, frame))
        texture::HWY_NAMESPACE::write_slopes(b);
}

SIMD_END

#endif
