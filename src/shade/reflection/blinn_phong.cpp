// Blinn-Phong as MTL's illum 2 means it: Lambert plus Ks max(n.h, 0)^Ns for every light before the
// surface, h halfway between light and eye, not normalised for energy; Ns below 1 counts as 1, with
// Ks Ns for Ks. Blinn 1977, [Primer 7].
#include "shade/stage.h"

#define SIMD_FILE "shade/reflection/blinn_phong.cpp"
#include "simd/for_each_target.h"

#include "shade/reflection/highlight-inl.h"

SIMD_BEGIN(scanout::shade::reflection)

struct BlinnPhong {
    SIMD_INLINE F32 cosine(const Vec3F32& normal, const Vec3F32& eye, const Vec3F32& light) const {
        // Light from behind a surface meets none of its mirrors, though n.h may still be near 1.
        return select(dot(normal, light) > F32(0.0F), half_vector_cosine(normal, eye, light),
                      F32(0.0F));
    }
    SIMD_INLINE F32 reflectance(F32 lobe, const Vec3F32&, const Vec3F32&, int) const {
        return lobe;
    }
};

void blinn_phong_run(ShadingBlock& b, const FrameState& frame) {
    diffuse_and_highlights(b, frame, BlinnPhong());
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::reflection {

SIMD_REGISTER(blinn_phong_run);

extern const ReflectionStage blinn_phong;
constinit const ReflectionStage blinn_phong{
    {{.axis = "reflection",
      .name = "blinn_phong",
      .blurb = "Lambert plus a highlight where the half vector meets the normal; Ns below 1 fades "
               "it, to none at 0",
      .source = "Blinn 1977",
      .kind = Kind::model},
     Pass::called,
     {.normal = true, .ray = true},
     [](ShadingBlock& block, const FrameState& frame) {
         SIMD_CALL(blinn_phong_run, block, frame);
     }},
    {}};

} // namespace scanout::shade::reflection
#endif
