// Phong: Lambert plus Ks max(r.e, 0)^Ns for every light before the surface, r the light's mirror
// image in it. Where light, normal and eye lie in one plane, the angle from r to the eye is twice
// that from the normal to the half vector: the same Ns makes a highlight half as wide as
// Blinn-Phong's. Phong 1975, [Primer 7].
#include "shade/stage.h"

#define SIMD_FILE "shade/reflection/phong.cpp"
#include "simd/for_each_target.h"

#include "shade/reflection/highlight-inl.h"

SIMD_BEGIN(scanout::shade::reflection)

struct Phong {
    SIMD_INLINE F32 cosine(const Vec3F32& normal, const Vec3F32& eye, const Vec3F32& light) const {
        const F32 n_l = dot(normal, light);
        const F32 between = F32(2.0F) * n_l * dot(normal, eye) - dot(light, eye);
        return select(n_l > F32(0.0F), between, F32(0.0F));
    }
    SIMD_INLINE F32 reflectance(F32 lobe, const Vec3F32&, const Vec3F32&, int) const {
        return lobe;
    }
};

void phong_run(ShadingBlock& b, const FrameState& frame) {
    diffuse_and_highlights(b, frame, Phong());
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::reflection {

SIMD_REGISTER(phong_run);

extern const ReflectionStage phong;
constinit const ReflectionStage phong{
    {{.axis = "reflection",
      .name = "phong",
      .blurb = "Lambert plus a highlight where the light's mirror image meets the eye",
      .source = "Phong 1975",
      .kind = Kind::model},
     Pass::called,
     {.normal = true, .ray = true},
     [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(phong_run, block, frame); }},
    {}};

} // namespace scanout::shade::reflection
#endif
