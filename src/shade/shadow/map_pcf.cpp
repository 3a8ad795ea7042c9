// A filtered shadow map (PCF): the share of k x k texels about the receiver that hide it. Each
// texel is compared by itself, because depths must not be averaged. Reeves, Salesin and Cook 1987.
// Its parts: this kernel, and the pass that draws the map (frame/pass/shadow_maps.h).
#include "shade/stage.h"

#define SIMD_FILE "shade/shadow/map_pcf.cpp"
#include "simd/for_each_target.h"

#include "shade/shadow/map-inl.h"

SIMD_BEGIN(scanout::shade::shadow)

void map_pcf_run(ShadingBlock& b, const FrameState& frame) {
    const int k = frame.shadow_filter;
    shadow_by_maps(b, frame,
                   [k](const ShadowMap& m, const Receiver& r, const LightShadow&)
                       SIMD_LAMBDA { return hidden_square(m, r, k); });
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::shadow {

SIMD_REGISTER(map_pcf_run);

extern const ShadowStage map_pcf;
constinit const ShadowStage map_pcf{
    {{.axis = "shadow",
      .name = "map_pcf",
      .blurb = "the share of k x k texels of the map that hide the point",
      .source = "Reeves, Salesin and Cook 1987",
      .kind = Kind::rung},
     Pass::shadow,
     {.position = true, .facing = true},
     [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(map_pcf_run, block, frame); }},
    {.by = ShadowBy::maps, .filtered = true}};

} // namespace scanout::shade::shadow
#endif
