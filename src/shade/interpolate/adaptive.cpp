// Adaptive interpolation: picks for every triangle the cheapest of affine, every 16 pixels, every 8
// pixels and perspective whose error bound is at most 1/256 texel and half a code
// (shade/setup/interpolation_step.h; HARD-CASES L3).
#include "shade/setup/interpolation_step.h"
#include "shade/stage.h"

#define SIMD_FILE "shade/interpolate/adaptive.cpp"
#include "simd/for_each_target.h"

#include "shade/interpolate/affine-inl.h"

SIMD_BEGIN(scanout::shade::interpolate)

struct Adaptive {
    static constexpr bool kExact = true; // within 1/256 texel
    static SIMD_INLINE void lanes(ShadingBlock& b, const Wanted& want, const Run& run) {
        switch (run.primitive->step) {
        case kAffine:
            affine_lanes(b, want, run);
            break;
        case 16:
            stepped_lanes<16>(b, want, run);
            break;
        case 8:
            stepped_lanes<8>(b, want, run);
            break;
        default:
            perspective_lanes(b, want, run);
        }
    }
};

void adaptive_run(ShadingBlock& b, const FrameState& frame) {
    run_rung<Adaptive>(b, frame);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::interpolate {

SIMD_REGISTER(adaptive_run);

extern const Stage adaptive;
constinit const Stage adaptive{
    {.axis = "interpolate",
     .name = "adaptive",
     .blurb = "per triangle the cheapest within 1/256 texel and half a code",
     .source = "Hecker 1995, by the ratio of distances",
     .kind = Kind::rung},
    Pass::interpolation,
    {.primitive = true, .steps = true},
    [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(adaptive_run, block, frame); }};

} // namespace scanout::shade::interpolate
#endif
