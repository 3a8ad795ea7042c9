// Toon shading: the cosine of the light's angle is cut to one of three flat tones, each the middle
// of its third. The highlight, where Ks and Ns give one, is hard: all of Ks where Blinn-Phong's
// lobe is at least a half, nothing elsewhere. Lake, Marshall, Harris and Blackwell 2000, with tones
// that keep the mean brightness of a surface. It has bands where others are smooth; ambient light
// and shadows stay as they are.
#include "shade/stage.h"

#define SIMD_FILE "shade/reflection/toon.cpp"
#include "simd/for_each_target.h"

#include "shade/reflection/highlight-inl.h"

SIMD_BEGIN(scanout::shade::reflection)

constexpr float kTones = 3;

// The share of a light that a matt surface reflects; cosine at most about 1, NaN as 0.
SIMD_INLINE F32 tone_of(F32 cosine) {
    const F32 band = minimum(F32(hn::Floor((cosine * F32(kTones)).raw)), F32(kTones - 1));
    return select(cosine > F32(0.0F), (band + F32(0.5F)) * F32(1 / kTones), F32(0.0F));
}

// 1 where the lobe n.h^Ns is at least a half and the light lies in front of the surface; else 0.
SIMD_INLINE F32 hard_highlight(const Vec3F32& normal, const Vec3F32& eye, const Vec3F32& light,
                               F32 cosine, F32 exponent) {
    const F32 lobe = minimum(half_vector_cosine(normal, eye, light), F32(1.0F));
    const auto bright = (cosine > F32(0.0F)) & (exponent * log2_of_share(lobe) >= F32(-1.0F));
    return select(bright, F32(1.0F), F32(0.0F));
}

// Sets b.colour.
template <bool kHighlight>
HWY_NOINLINE void toon(ShadingBlock& b, const FrameState& frame) {
    const std::size_t light_count = b.lit ? frame.lights.size() : 0;
    const Ambient ambient = ambient_of(b);
    for (int i = 0; i < b.count; i += kLanes) {
        const Vec3F32 normal = load_vec3<Vec3F32>(b.normal, i);
        const Vec3F32 eye = kHighlight ? eye_at(b, frame, i) : normal;
        Vec3F32 diffuse = ambient_at(b, ambient, i), mirrored = splat(F32(0.0F));
        for (std::size_t k = 0; k < light_count; ++k) {
            const Light light = light_at(b, frame, k, i);
            const F32 cosine = dot(normal, light.towards);
            diffuse = diffuse + light.colour * tone_of(cosine);
            if constexpr (kHighlight)
                mirrored = mirrored + light.colour * hard_highlight(normal, eye, light.towards,
                                                                    cosine, exponent_at(b, i));
        }
        Vec3F32 colour = load_vec3<Vec3F32>(b.albedo, i) * diffuse;
        if constexpr (kHighlight) colour = colour + specular_at(b, i) * mirrored;
        store_vec3(colour, b.colour, i);
    }
}

void toon_matt_run(ShadingBlock& b, const FrameState& frame) {
    toon<false>(b, frame);
}
void toon_run(ShadingBlock& b, const FrameState& frame) {
    if (has_highlight(b))
        toon<true>(b, frame);
    else
        toon<false>(b, frame);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::reflection {

SIMD_REGISTER(toon_run);
SIMD_REGISTER(toon_matt_run);

namespace {

constexpr Technique kToon{.axis = "reflection",
                          .name = "toon",
                          .blurb = "three flat tones, and a hard highlight where there is one",
                          .source = "Lake, Marshall, Harris and Blackwell 2000",
                          .kind = Kind::model};
constinit const Stage toon_matt{
    kToon, Pass::called, {.normal = true}, [](ShadingBlock& block, const FrameState& frame) {
        SIMD_CALL(toon_matt_run, block, frame);
    }};

} // namespace

extern const ReflectionStage toon;
constinit const ReflectionStage toon{
    {kToon,
     Pass::called,
     {.normal = true, .ray = true},
     [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(toon_run, block, frame); }},
    {.matt = &toon_matt}};

} // namespace scanout::shade::reflection
#endif
