// Blinn-Phong with its energy: a surface of Ks 1 reflects all light that falls on it straight and
// never more, whatever Ns, so a sharper highlight is a brighter one. MTL leaves the 1/pi of the
// diffuse part out, so a light of colour 1 is one of irradiance pi, and the highlight is pi f n.l
// with f = Ks (Ns + 2) (Ns + 4) / (8 pi (2^(-Ns/2) + Ns)) max(n.h, 0)^Ns. The usual (Ns + 8) / (8
// pi) comes close to it, but reflects up to 7 % more than arrives (at Ns 10). Blinn 1977;
// Giesen 2009.
#include "math/transcendental.h"
#include "shade/stage.h"

#define SIMD_FILE "shade/reflection/blinn_phong_normalised.cpp"
#include "simd/for_each_target.h"

#include "shade/reflection/highlight-inl.h"

SIMD_BEGIN(scanout::shade::reflection)

struct BlinnPhongNormalised {
    const float (&factor)[kPaddedBlock];
    SIMD_INLINE F32 cosine(const Vec3F32& normal, const Vec3F32& eye, const Vec3F32& light) const {
        return half_vector_cosine(normal, eye, light);
    }
    SIMD_INLINE F32 reflectance(F32 lobe, const Vec3F32& normal, const Vec3F32& light,
                                int item) const {
        const F32 falls = maximum(dot(normal, light), F32(0.0F));
        return load<F32>(factor + item) * falls * lobe;
    }
};

void blinn_phong_normalised_run(ShadingBlock& b, const FrameState& frame) {
    if (!has_highlight(b)) return diffuse(b, frame);
    alignas(64) float factor[kPaddedBlock];
    for_exponents(
        b, [](double ns) { return (ns + 2) * (ns + 4) / (8 * (scanout::exp2(-ns / 2) + ns)); },
        factor);
    diffuse_and_highlights(b, frame, BlinnPhongNormalised{factor});
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::reflection {

SIMD_REGISTER(blinn_phong_normalised_run);

extern const ReflectionStage blinn_phong_normalised;
constinit const ReflectionStage blinn_phong_normalised{
    {{.axis = "reflection",
      .name = "blinn_phong_normalised",
      .blurb = "Blinn-Phong whose highlight reflects no more than Ks of the light; Kd adds to it",
      .source = "Blinn 1977, Giesen 2009",
      .kind = Kind::model},
     Pass::called,
     {.normal = true, .ray = true},
     [](ShadingBlock& block, const FrameState& frame) {
         SIMD_CALL(blinn_phong_normalised_run, block, frame);
     }},
    {}};

} // namespace scanout::shade::reflection
#endif
