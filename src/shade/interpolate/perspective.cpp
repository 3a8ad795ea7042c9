// Perspective-correct interpolation: f = sum(b_i f_i / w_i) / sum(b_i / w_i) with the screen's
// areas b_i: Heckbert and Moreton 1991, [Compendium 5]. The areas come from the exact edge
// functions, all terms are positive, and so nothing cancels at any ratio of distances.
#include "shade/stage.h"

#define SIMD_FILE "shade/interpolate/perspective.cpp"
#include "simd/for_each_target.h"

#include "shade/interpolate/interpolate-inl.h"

SIMD_BEGIN(scanout::shade::interpolate)

struct Perspective {
    static constexpr bool kExact = true; // within 1/256 texel
    static SIMD_INLINE void lanes(ShadingBlock& b, const Wanted& want, const Run& run) {
        if (run.primitive == nullptr)
            perspective_own(b, want, run);
        else
            perspective_lanes(b, want, run);
    }
};

void perspective_run(ShadingBlock& b, const FrameState& frame) {
    run_rung<Perspective>(b, frame);
}

SIMD_END
#if SIMD_ONCE
namespace scanout::shade::interpolate {

SIMD_REGISTER(perspective_run);

extern const Stage perspective;
constinit const Stage perspective{
    {.axis = "interpolate",
     .name = "perspective",
     .blurb = "weights divided by w at every pixel: straight lines stay straight",
     .source = "Heckbert and Moreton 1991",
     .kind = Kind::rung},
    Pass::interpolation,
    {},
    [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(perspective_run, block, frame); }};

} // namespace scanout::shade::interpolate
#endif
