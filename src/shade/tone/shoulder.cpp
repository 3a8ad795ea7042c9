// The scene's brightest light becomes white, and darker light changes only if it must: up to a knee
// it stays as it is, above it rolls off to 1. A film's shoulder without its toe. With w the most
// light that there is (FrameState::white) the knee stands at 1 / w, and above it runs
//     g(t) = t (1 + t / s^2) / (1 + t),    s = w + 1,
// scaled to go from the knee, with slope 1, to 1 at w: Reinhard et al. 2002, eq. 4. As w goes to 1
// the curve goes to the clamp: a scene that gets a little brighter looks a little different.
// Applied, as all tone curves, to the light of primitives, before samples are mixed.
#include "shade/stage.h"

#define SIMD_FILE "shade/tone/shoulder.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::shade::tone)

void shoulder_run(ShadingBlock& b, const FrameState& frame) {
    const float white = frame.white, knee = 1.0F / white, room = 1.0F - knee,
                inverse_square = 1.0F / ((white + 1.0F) * (white + 1.0F));
    for (auto& channel : b.colour)
        for (int i = 0; i < b.count; i += kLanes) {
            const F32 x = minimum(load<F32>(channel + i), F32(white));
            const F32 above = maximum(x - F32(knee), F32(0.0F));
            // room * g(above / room). With room 0, no light is above the knee.
            const F32 rolled = F32(knee) + (above * (F32(room) + above * F32(inverse_square))) /
                                               maximum(F32(room) + above, F32(0x1p-60F));
            store(select(x > F32(knee), minimum(rolled, F32(1.0F)), x), channel + i);
        }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::tone {

SIMD_REGISTER(shoulder_run);

extern const ToneStage shoulder;
constinit const ToneStage shoulder{
    {{.axis = "tone",
      .name = "shoulder",
      .blurb = "as bright as it gets is white; darks stay, brights bend",
      .source = "Reinhard et al. 2002, eq. 4",
      .kind = Kind::model},
     Pass::tone,
     {},
     [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(shoulder_run, block, frame); }},
    {.exact_below_white = true}};

} // namespace scanout::shade::tone
#endif
