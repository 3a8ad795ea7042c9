// Divides by w every 16 pixels and interpolates linearly in between: HARD-CASES 33.
#include "shade/stage.h"

#define SIMD_FILE "shade/interpolate/affine_16.cpp"
#include "simd/for_each_target.h"

#include "shade/interpolate/affine-inl.h"

SIMD_BEGIN(scanout::shade::interpolate)

struct Affine16 {
    static constexpr bool kExact = false;
    static SIMD_INLINE void lanes(ShadingBlock& b, const Wanted& want, const Run& run) {
        stepped_lanes<16>(b, want, run);
    }
};

void affine_16_run(ShadingBlock& b, const FrameState& frame) {
    run_rung<Affine16>(b, frame);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::interpolate {

SIMD_REGISTER(affine_16_run);

extern const Stage affine_16;
constinit const Stage affine_16{
    {.axis = "interpolate",
     .name = "affine_16",
     .blurb = "exact every 16 pixels, straight between: 1/2000 of the range where distances double",
     .source = "Hecker 1995",
     .kind = Kind::rung},
    Pass::interpolation,
    {.primitive = true},
    [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(affine_16_run, block, frame); }};

} // namespace scanout::shade::interpolate
#endif
