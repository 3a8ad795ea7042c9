// A film's response, for scenes brighter than 1: darks keep their contrast, highlights roll off
// instead of being cut. Narkowicz 2015: a rational fit of the Academy's reference rendering,
//     f(x) = x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14),
// which reaches 1 at x = 7.24. It is applied to what a primitive shows, before samples are mixed:
// the background keeps the colour that was asked for, and one bright sample does not drown an edge.
#include "shade/stage.h"

#define SIMD_FILE "shade/tone/filmic.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::shade::tone)

void filmic_run(ShadingBlock& b) {
    for (auto& channel : b.colour)
        for (int i = 0; i < b.count; i += kLanes) {
            // Beyond 16 the curve is above 1 for good; its squares must not overflow.
            const F32 x = minimum(maximum(load<F32>(channel + i), F32(0.0F)), F32(16.0F));
            const F32 above = x * (F32(2.51F) * x + F32(0.03F));
            const F32 below = x * (F32(2.43F) * x + F32(0.59F)) + F32(0.14F);
            store(minimum(above / below, F32(1.0F)), channel + i);
        }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::tone {

SIMD_REGISTER(filmic_run);

extern const ToneStage filmic;
constinit const ToneStage filmic{
    {{.axis = "tone",
      .name = "filmic",
      .blurb = "highlights roll off as on film: up to 7 times white shows",
      .source = "Narkowicz 2015, a fit of ACES",
      .kind = Kind::model},
     Pass::tone,
     {},
     [](ShadingBlock& block, const FrameState& /*frame*/) { SIMD_CALL(filmic_run, block); }},
    {}};

} // namespace scanout::shade::tone
#endif
