// What the models with a highlight share: the eye, the normal, and the sum over lights.
#if defined(SCANOUT_SHADE_HIGHLIGHT_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SCANOUT_SHADE_HIGHLIGHT_INL_H
#undef SCANOUT_SHADE_HIGHLIGHT_INL_H
#else
#define SCANOUT_SHADE_HIGHLIGHT_INL_H
#endif

#include "math/transcendental-inl.h"
#include "shade/reflection/diffuse-inl.h"

SIMD_BEGIN(scanout::shade::reflection)

// Unit, from the surface.
SIMD_INLINE Vec3F32 eye_at(const ShadingBlock& b, const FrameState& frame, int item) {
    const F32 zero = 0.0F, one = 1.0F;
    if (b.eye != nullptr)
        return {load<F32>(b.eye[0] + item), load<F32>(b.eye[1] + item), load<F32>(b.eye[2] + item)};
    const Vec3F32 back = {-(frame.orthographic ? zero : load<F32>(b.ray_x + item)),
                          -(frame.orthographic ? zero : load<F32>(b.ray_y + item)), one};
    return back * (one / length(back));
}

// Ns of a lane: the material's own, or what its map made of it. Exponent 0 would shine on all of a
// surface, where Ns 0 means no highlight: below 1 the exponent stays 1, and Ks fades with Ns. So
// nothing jumps, and black in map_Ns never shines more than white.
SIMD_INLINE F32 ns_at(const ShadingBlock& b, int item) {
    return b.map[kShininessMap].texture != nullptr ? load<F32>(b.shininess + item)
                                                   : F32(b.material->shininess);
}
SIMD_INLINE F32 exponent_at(const ShadingBlock& b, int item) {
    return maximum(ns_at(b, item), F32(1.0F));
}
// Ks of a lane, likewise.
SIMD_INLINE Vec3F32 specular_at(const ShadingBlock& b, int item) {
    const Vec3F32 ks = b.map[kSpecularMap].texture != nullptr
                           ? load_vec3<Vec3F32>(b.specular, item)
                           : everywhere<Vec3F32>(b.material->specular);
    return ks * minimum(ns_at(b, item), F32(1.0F));
}

// of_exponent(exponent) for every lane. In double, one by one: the same for the same Ns wherever it
// comes from.
template <class OfExponent>
SIMD_INLINE void for_exponents(const ShadingBlock& b, OfExponent of_exponent,
                               float (&out)[kPaddedBlock]) {
    const auto found = [&](float ns) {
        return static_cast<float>(of_exponent(double{ns < 1 ? 1.0F : ns}));
    };
    const float own = found(b.material->shininess);
    for (float& item : out)
        item = own;
    if (b.map[kShininessMap].texture == nullptr) return;
    for (int i = 0; i < b.count; ++i)
        out[i] = found(b.shininess[i]);
}

// Of some lanes.
struct Gloss {
    Vec3F32 ks;
    F32 exponent;
};

// Of a light, at all lanes. Three passes: a register's way through one of them is a chain of some
// hundred cycles, and registers overlap only as far as the processor looks ahead. The second and
// third are pow_of_share: exponents are at least 1 (exponent_at).
template <class Highlight, class LightAt>
SIMD_INLINE void add_highlights(ShadingBlock& b, const Highlight& highlight, const LightAt& light,
                                const Gloss& gloss, const float (&eyes)[3][kPaddedBlock], int first,
                                int end) {
    alignas(64) float cosine[kPaddedBlock], log_power[kPaddedBlock];
    for (int i = first; i < end; i += kLanes) {
        const Vec3F32 normal = load_vec3<Vec3F32>(b.normal, i), eye = load_vec3<Vec3F32>(eyes, i);
        store(highlight.cosine(normal, eye, light(i).towards), cosine + i);
    }
    for (int i = first; i < end; i += kLanes)
        store(gloss.exponent * log2_of_share(minimum(F32(1.0F), load<F32>(cosine + i))),
              log_power + i);
    for (int i = first; i < end; i += kLanes) {
        const Light& l = light(i);
        const F32 lobe = exp2_to_share(load<F32>(log_power + i));
        const F32 reflectance =
            highlight.reflectance(lobe, load_vec3<Vec3F32>(b.normal, i), l.towards, i);
        const Vec3F32 below = load_vec3<Vec3F32>(b.colour, i);
        store_vec3(below + (l.colour * gloss.ks) * reflectance, b.colour, i);
    }
}

// Not inlined: blocks with and without maps share one copy of it. Light by light, so that all that
// the lanes share stays in registers.
template <class Highlight>
HWY_NOINLINE void light_lanes(ShadingBlock& b, const FrameState& frame, const Highlight& highlight,
                              const Gloss& of_items, int first, int end) {
    const std::size_t light_count = frame.lights.size();
    const Gloss gloss = of_items; // no store writes to it
    const Ambient ambient = ambient_of(b);
    alignas(64) float eyes[3][kPaddedBlock];
    for (int i = first; i < end; i += kLanes) {
        store_vec3(eye_at(b, frame, i), eyes, i);
        store_vec3(diffuse_at(b, frame, ambient, light_count, i), b.colour, i);
    }
    for (std::size_t k = 0; k < light_count; ++k) {
        const auto add = [&](const auto& light) SIMD_LAMBDA {
            add_highlights(b, highlight, light, gloss, eyes, first, end);
        };
        if (varies(frame, k)) {
            add([&](int i) SIMD_LAMBDA { return light_at(b, frame, k, i); });
        } else {
            const Light everywhere = light_everywhere(frame, k);
            add([&](int) SIMD_LAMBDA -> const Light& { return everywhere; });
        }
    }
}

SIMD_INLINE bool has_highlight(const ShadingBlock& b) {
    return b.lit && scene::has_highlight(*b.material);
}

// Sets b.colour: the diffuse part and, where there are highlights, light * Ks * share for every
// light. A model of them has two functions:
//     F32 cosine(normal, eye, light)              whose power is the lobe: above 1 counts as 1,
//                                                 NaN and below 0 as none
//     F32 share(F32 lobe, normal, light, lane)    of the light, for white Ks
template <class Highlight>
SIMD_INLINE void diffuse_and_highlights(ShadingBlock& b, const FrameState& frame,
                                        const Highlight& highlight) {
    if (!has_highlight(b)) return diffuse(b, frame);
    const bool mapped =
        b.map[kSpecularMap].texture != nullptr || b.map[kShininessMap].texture != nullptr;
    const int step = mapped ? kLanes : b.count;
    for (int i = 0; i < b.count; i += step) {
        const Gloss gloss = {specular_at(b, i), exponent_at(b, i)};
        light_lanes(b, frame, highlight, gloss, i, i + step);
    }
}

// n.h, h halfway between eye and light.
SIMD_INLINE F32 half_vector_cosine(const Vec3F32& normal, const Vec3F32& eye,
                                   const Vec3F32& light) {
    const Vec3F32 h = eye + light;
    const F32 size = length(h);
    // 0: the light shines straight into the eye through the surface; no highlight.
    return select(size > F32(0x1p-20F), dot(normal, h) / size, F32(0.0F));
}

SIMD_END

#endif
