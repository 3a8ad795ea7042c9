// Light from a sky that is as bright everywhere, and from a ground likewise: a surface that leans
// by an angle from the sky's middle sees (1 + cos) / 2 of the sky, and the ground with the rest.
// Forms show where no other light reaches. Nishita and Nakamae 1986 for the share; no 1/pi, as in
// MTL.
#include "shade/stage.h"

#define SIMD_FILE "shade/light/hemisphere.cpp"
#include "simd/for_each_target.h"

#include "simd/vec3-inl.h"

SIMD_BEGIN(scanout::shade::light)

// Of the sky that a surface sees; normals are unit but for rounding.
SIMD_INLINE F32 seen_of(const ShadingBlock& b, const scene::ViewLight& light, int item) {
    const F32 cosine = dot(load_vec3<Vec3F32>(b.normal, item), everywhere<Vec3F32>(light.towards));
    return minimum(maximum(F32(0.5F) + F32(0.5F) * cosine, F32(0.0F)), F32(1.0F));
}

void hemisphere_run(ShadingBlock& b, const FrameState& frame) {
    if (!b.lit) return;
    b.hemispheres = true;
    for (std::size_t k = 0; k < frame.hemispheres.size(); ++k) {
        const scene::ViewLight& light = frame.hemispheres.data()[k];
        const Vec3F32 sky = everywhere<Vec3F32>(light.colour),
                      ground = everywhere<Vec3F32>(light.ground);
        for (int i = 0; i < b.count; i += kLanes) {
            const F32 seen = seen_of(b, light, i);
            Vec3F32 arrives = sky * seen + ground * (F32(1.0F) - seen);
            if (k > 0) arrives = load_vec3<Vec3F32>(b.from_hemispheres, i) + arrives;
            store_vec3(arrives, b.from_hemispheres, i);
        }
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::light {

SIMD_REGISTER(hemisphere_run);

extern const LightStage hemisphere;
constinit const LightStage hemisphere{
    {{.axis = "light",
      .name = "hemisphere",
      .blurb = "a bright sky and a darker ground, by how a surface is turned",
      .source = "Nishita and Nakamae 1986",
      .kind = Kind::effect},
     Pass::light,
     {.normal = true},
     [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(hemisphere_run, block, frame); }},
    {scene::LightKind::hemisphere}};

} // namespace scanout::shade::light
#endif
