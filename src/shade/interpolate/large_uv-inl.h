// Texture coordinates of triangles that repeat a texture very often (HARD-CASES 36): floats of u, v
// and 1 / w hold no place within a repeat there, so those of such triangles are mixed in double,
// and moved by whole repeats towards 0 before they are rounded.
#if defined(SCANOUT_SHADE_LARGE_UV_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_LARGE_UV_INL_H
#undef SCANOUT_SHADE_LARGE_UV_INL_H
#else
#define SCANOUT_SHADE_LARGE_UV_INL_H
#endif

#include "shade/stage.h"

#include "shade/interpolate/weights-inl.h"

SIMD_BEGIN(scanout::shade::interpolate)

// To the nearest whole number, where |x| < 2^51; else near to it.
SIMD_INLINE F64 nearest_whole(F64 x) {
    const F64 magic = 0x1.8p52;
    return (x + magic) - magic;
}

// The shares of vertices 1 and 2 at a sample, as `weights` has them in floats.
struct ExactWeights {
    F64 one, two;
};
SIMD_INLINE ExactWeights exact_weights(const Primitive& t, F64 x, F64 y) {
    const F64 zero = 0.0;
    F64 p[3];
    SIMD_FOR (int k = 0; k < 3; ++k)
        p[k] = maximum(area_at(t, k, x, y), zero) * F64(t.exact_inverse_w[k]);
    const F64 sum = (p[0] + p[1]) + p[2];
    const auto some = sum > zero; // none: a clipped triangle's edge, where it is snapped
    const F64 divisor = select(some, sum, F64(1.0)), third = 1.0 / 3;
    return {select(some, p[1] / divisor, third), select(some, p[2] / divisor, third)};
}

// step: 0 where no whole repeats can be removed.
SIMD_INLINE F32 mix_exactly(const ExactWeights& w, const double (&f)[3], double step) {
    const F64 f0 = f[0], f1 = f[1], f2 = f[2];
    const F64 mixed = f0 + (w.one * (f1 - f0) + w.two * (f2 - f0));
    const F64 within = minimum(maximum(mixed, minimum(minimum(f0, f1), f2)),
                               maximum(maximum(f0, f1), f2)); // HARD-CASES 34
    if (step == 0) return to_f32(within);
    return to_f32(within - nearest_whole(within / F64(step)) * F64(step));
}

// u and v of a block's triangles that have large ones.
SIMD_INLINE void write_large_uv(ShadingBlock& b) {
    for (const Run* run = b.run; run != b.run + b.runs; ++run) {
        if (run->primitive == nullptr || !run->primitive->large_uv) continue;
        const Primitive& t = *run->primitive;
        for (int i = run->first; i < run->first + run->count; i += kLanes) {
            const ExactWeights w =
                exact_weights(t, to_f64(load<I32>(b.x + i)), to_f64(load<I32>(b.y + i)));
            store(mix_exactly(w, t.exact_uv[0], b.uv_step.x), b.u + i);
            store(mix_exactly(w, t.exact_uv[1], b.uv_step.y), b.v + i);
        }
    }
}

SIMD_END

#endif
