// A spot light, a point light with a cone: full inside the inner angle, none outside the outer one,
// and between them a smooth step of the cosine (Hermite's cubic). Warn 1983.
#include "shade/stage.h"

#define SIMD_FILE "shade/light/spot.cpp"
#include "simd/for_each_target.h"

#include "shade/light/write-inl.h"

SIMD_BEGIN(scanout::shade::light)

void spot_run(ShadingBlock& b, const FrameState& frame) {
    for_each_lane(b, frame, scene::LightKind::spot,
                  [&](const scene::ViewLight& light, BlockLight& lanes, int i) SIMD_LAMBDA {
                      Arrival a = arrival(b, light, i);
                      const F32 cosine =
                          F32(0.0F) - dot(a.towards, everywhere<Vec3F32>(light.axis));
                      const float width = light.cos_inner - light.cos_outer;
                      const F32 slope = width > 0 ? 1.0F / width : 0.0F; // 0: a hard edge
                      const F32 rise = maximum((cosine - F32(light.cos_outer)) * slope, F32(0.0F));
                      const F32 t = minimum(rise, F32(1.0F));
                      const F32 smooth = (t * t) * (F32(3.0F) - F32(2.0F) * t);
                      a.attenuation =
                          a.attenuation * select(cosine >= F32(light.cos_inner), F32(1.0F), smooth);
                      store_arrival(a, light, lanes, i);
                  });
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::light {

SIMD_REGISTER(spot_run);

extern const LightStage spot;
constinit const LightStage spot{
    {{.axis = "light",
      .name = "spot",
      .blurb = "a point light with a cone and a soft rim",
      .source = "Warn 1983",
      .kind = Kind::effect},
     Pass::light,
     {.position = true},
     [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(spot_run, block, frame); }},
    {scene::LightKind::spot}};

} // namespace scanout::shade::light
#endif
