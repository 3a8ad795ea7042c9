// Perspective-correct interpolation: f = sum(b_i f_i / w_i) / sum(b_i / w_i) with the screen's
// areas b_i [A ch.5], Heckbert and Moreton 1991. The areas come from the exact edge functions, all
// terms are positive, and so nothing cancels at any ratio of distances. A result never leaves the
// range of its vertices, not even by rounding: u just below 0 would show the texel at the other end
// of the texture (HARD-CASES 34).
#include "shade/stage.h"

#define SIMD_FILE "shade/interpolate/perspective.cpp"
#include "simd/for_each_target.h"

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

template <Normals kNormals, bool kPosition>
HWY_INLINE void interpolate(Block& b, const FrameState& frame) {
    const bool normal = frame.attributes.normal, colour = frame.attributes.colour;
    const bool uv = frame.attributes.uv && any_map(b);
    const float kd[3] = {b.material->diffuse.x, b.material->diffuse.y, b.material->diffuse.z};
    for (const Run* run = b.run; run != b.run + b.runs; ++run) {
        const Primitive& t = *run->primitive;
        for (int i = run->first; i < run->first + run->count; i += kLanesX8) {
            const Weights w =
                weights(t, to_f64(load<I32x8>(b.x + i)), to_f64(load<I32x8>(b.y + i)));
            if (normal)
                normals<kNormals>(t, frame, w, b.normal[0] + i, b.normal[1] + i, b.normal[2] + i);
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

template <bool kPosition>
HWY_INLINE void interpolate_normals(Block& b, const FrameState& frame) {
    if (frame.corner_normals)
        interpolate<Normals::raw, kPosition>(b, frame);
    else if (frame.sides == Sides::eye)
        interpolate<Normals::turned, kPosition>(b, frame);
    else
        interpolate<Normals::unit, kPosition>(b, frame);
}

void perspective_run(Block& b, const FrameState& frame) {
    if (!b.lit) return;
    if (frame.attributes.position)
        interpolate_normals<true>(b, frame);
    else
        interpolate_normals<false>(b, frame);
    if (frame.attributes.footprint && any_map(b)) texture::HWY_NAMESPACE::write_slopes(b);
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
