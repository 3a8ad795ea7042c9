// What the interpolations share: a rung says how the weights of vertices 1 and 2 (vertex 0 has the
// rest) come about at a lane; all else follows from them. The weights of a run are computed
// perspective-correctly or approximately, then normals, uv and colours are mixed by them. A result
// never leaves the range of its vertices, not even by rounding: u just below 0 would show the texel
// at the other end of the texture (HARD-CASES 34).
#if defined(SCANOUT_SHADE_INTERPOLATE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_INTERPOLATE_INL_H
#undef SCANOUT_SHADE_INTERPOLATE_INL_H
#else
#define SCANOUT_SHADE_INTERPOLATE_INL_H
#endif

#include "shade/stage.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade::interpolate)

// Of vertices 1 and 2.
struct Weights {
    F32x8 one, two;
};

HWY_INLINE F64x8 area_at(const Primitive& t, int k, F64x8 x, F64x8 y) {
    return (F64x8(t.a[k]) * x + F64x8(t.b[k]) * y) + F64x8(t.c[k]);
}

HWY_INLINE Weights weights(const Primitive& t, F64x8 x, F64x8 y) {
    F64x8 b0 = area_at(t, 0, x, y), b1 = area_at(t, 1, x, y), b2 = area_at(t, 2, x, y);
    if (t.clipped) {
        // The snapped edge may lie a little further out than the exact one. A common factor brings
        // the weights into the range of a float.
        const F64x8 zero = 0.0;
        b0 = maximum(b0, zero);
        b1 = maximum(b1, zero);
        b2 = maximum(b2, zero);
        const F64x8 largest = maximum(maximum(b0, b1), b2);
        const auto some = largest > zero;
        const F64x8 divisor = select(some, largest, F64x8(1.0));
        b0 = select(some, b0 / divisor, F64x8(1.0));
        b1 = select(some, b1 / divisor, F64x8(1.0));
        b2 = select(some, b2 / divisor, F64x8(1.0));
    }
    const F32x8 p0 = to_f32(b0) * F32x8(t.inverse_w[0]);
    const F32x8 p1 = to_f32(b1) * F32x8(t.inverse_w[1]);
    const F32x8 p2 = to_f32(b2) * F32x8(t.inverse_w[2]);
    const F32x8 sum = (p0 + p1) + p2;
    return {p1 / sum, p2 / sum};
}

HWY_INLINE F32x8 mix(const Weights& w, const float (&vertex)[3]) {
    const F32x8 f0 = vertex[0], f1 = vertex[1], f2 = vertex[2];
    const F32x8 f = f0 + (w.one * (f1 - f0) + w.two * (f2 - f0));
    const F32x8 low = minimum(minimum(f0, f1), f2), high = maximum(maximum(f0, f1), f2);
    return minimum(maximum(f, low), high);
}

// Unit normals in view space.
HWY_INLINE void normals(const Primitive& t, const FrameState& frame, const Weights& w, float* to_x,
                        float* to_y, float* to_z) {
    F32x8 n[3] = {mix(w, t.normal[0]), mix(w, t.normal[1]), mix(w, t.normal[2])};
    // The side that the eye sees is lit, whichever way the file wound it or its normals.
    const F32x8 side =
        (n[0] * F32x8(t.facing[0]) + n[1] * F32x8(t.facing[1])) + n[2] * F32x8(t.facing[2]);
    const F32x8 sign = select(side < F32x8(0.0F), F32x8(-1.0F), F32x8(1.0F));
    for (F32x8& component : n)
        component = component * sign;
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
            frame.attributes.uv && any_map(b),
            frame.attributes.colour,
            {b.material->diffuse.x, b.material->diffuse.y, b.material->diffuse.z}};
}

// One register of lanes from lane i on.
template <bool kPosition>
HWY_INLINE void put(Block& b, const FrameState& frame, const Wanted& want, const Primitive& t,
                    const Weights& w, int i) {
    if (want.normal) normals(t, frame, w, b.normal[0] + i, b.normal[1] + i, b.normal[2] + i);
    if (want.uv) {
        store(mix(w, t.uv[0]), b.u + i);
        store(mix(w, t.uv[1]), b.v + i);
    }
    if constexpr (kPosition)
        for (int c = 0; c < 3; ++c)
            store(mix(w, t.position[c]), b.position[c] + i);
    for (int c = 0; c < 3; ++c) {
        const F32x8 own = want.colour ? mix(w, t.colour[c]) : F32x8(1.0F);
        store(F32x8(want.kd[c]) * own, b.albedo[c] + i);
    }
}

// Exactly, at every lane of a run.
template <bool kPosition>
HWY_INLINE void perspective_lanes(Block& b, const FrameState& frame, const Wanted& want,
                                  const Run& run) {
    const Primitive& t = *run.primitive;
    for (int i = run.first; i < run.first + run.count; i += kLanesX8)
        put<kPosition>(b, frame, want, t,
                       weights(t, to_f64(load<I32x8>(b.x + i)), to_f64(load<I32x8>(b.y + i))), i);
}

SIMD_END

#endif
