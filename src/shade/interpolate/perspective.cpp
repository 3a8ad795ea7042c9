// Perspective-correct interpolation: f = sum(b_i f_i / w_i) / sum(b_i / w_i) with the screen's
// areas b_i [A ch.5], Heckbert and Moreton 1991. The areas come from the exact edge functions, all
// terms are positive, and so nothing cancels at any ratio of distances. A result never leaves the
// range of its vertices, not even by rounding: u just below 0 would show the texel at the other end
// of the texture (HARD-CASES 34).
#include "shade/check_lanes.h"
#include "shade/stage.h"

#define SIMD_FILE "shade/interpolate/perspective.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::shade::interpolate)

// Lanes of a block from `first` on, of which `count` are of the run.
struct Live {
    int first, count;
};

HWY_INLINE bool is_finite(float f) {
    return f - f == 0;
}

// A clamp makes a number of NaN, so that nothing would be seen after it.
HWY_INLINE void check_clamped([[maybe_unused]] F32x8 f, [[maybe_unused]] const Live& live) {
    if constexpr (kCheckLanes) {
        float lanes[kLanesX8];
        store(f, lanes);
        check_before_clamp(lanes, live.count < kLanesX8 ? live.count : kLanesX8, live.first);
    }
}

// Of vertices 1 and 2; vertex 0 has the rest.
struct Weights {
    F32x8 one, two;
    Live live;
};

HWY_INLINE Weights weights(const Primitive& t, F64x8 x, F64x8 y, const Live& live) {
    const auto weight = [&](int k) {
        return (F64x8(t.a[k]) * x + F64x8(t.b[k]) * y) + F64x8(t.c[k]);
    };
    F64x8 b0 = weight(0), b1 = weight(1), b2 = weight(2);
    if (t.clipped) {
        // The snapped edge may lie a little further out than the exact one. A common factor brings
        // the weights into the range of a float.
        check_clamped(to_f32(((b0 - b0) + (b1 - b1)) + (b2 - b2)), live); // 0 of what is finite
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
    return {p1 / sum, p2 / sum, live};
}

HWY_INLINE F32x8 mix(const Weights& w, const float (&vertex)[3]) {
    const F32x8 f0 = vertex[0], f1 = vertex[1], f2 = vertex[2];
    const F32x8 f = f0 + (w.one * (f1 - f0) + w.two * (f2 - f0));
    // Differences beyond all floats are what the clamp is for, too.
    if (kCheckLanes && is_finite(vertex[1] - vertex[0]) && is_finite(vertex[2] - vertex[0]))
        check_clamped(f, w.live);
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

template <bool kPosition>
HWY_INLINE void interpolate(Block& b, const FrameState& frame) {
    const bool normal = frame.attributes.normal, colour = frame.attributes.colour;
    const bool uv = frame.attributes.uv && any_map(b);
    const float kd[3] = {b.material->diffuse.x, b.material->diffuse.y, b.material->diffuse.z};
    for (const Run* run = b.run; run != b.run + b.runs; ++run) {
        const Primitive& t = *run->primitive;
        for (int i = run->first; i < run->first + run->count; i += kLanesX8) {
            const Weights w = weights(t, to_f64(load<I32x8>(b.x + i)), to_f64(load<I32x8>(b.y + i)),
                                      {i, run->first + run->count - i});
            if (normal) normals(t, frame, w, b.normal[0] + i, b.normal[1] + i, b.normal[2] + i);
            if (uv) {
                store(mix(w, t.uv[0]), b.u + i);
                store(mix(w, t.uv[1]), b.v + i);
            }
            if constexpr (kPosition)
                for (int c = 0; c < 3; ++c)
                    store(mix(w, t.position[c]), b.position[c] + i);
            for (int c = 0; c < 3; ++c) {
                const F32x8 own = colour ? mix(w, t.colour[c]) : F32x8(1.0F);
                store(F32x8(kd[c]) * own, b.albedo[c] + i);
            }
        }
    }
}

void perspective_run(Block& b, const FrameState& frame) {
    if (!b.lit) return;
    if (frame.attributes.position)
        interpolate<true>(b, frame);
    else
        interpolate<false>(b, frame);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::interpolate {

SIMD_REGISTER(perspective_run);

extern const Stage perspective;
constinit const Stage perspective{
    {.axis = "interpolate",
     .name = "perspective",
     .blurb = "weights divided by w at every pixel: straight lines stay straight",
     .source = "[A ch.5], Heckbert and Moreton 1991",
     .kind = Kind::rung},
    {},
    [](Block& block, const FrameState& frame) {
        SIMD_CALL(perspective_run)
        (block, frame);
    }};

} // namespace scanout::shade::interpolate
#endif
