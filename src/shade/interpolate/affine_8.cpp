// Divides by w every 8 pixels and interpolates linearly in between: HARD-CASES 33.
#include "shade/stage.h"

#define SIMD_FILE "shade/interpolate/affine_8.cpp"
#include "simd/for_each_target.h"

#include "shade/interpolate/affine-inl.h"

SIMD_BEGIN(scanout::shade::interpolate)

struct Affine8 {
    static constexpr bool kExact = false;
    static SIMD_INLINE void lanes(ShadingBlock& b, const Wanted& want, const Run& run) {
        stepped_lanes<8>(b, want, run);
    }
};

void affine_8_run(ShadingBlock& b, const FrameState& frame) {
    run_rung<Affine8>(b, frame);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::interpolate {

SIMD_REGISTER(affine_8_run);

extern const Stage affine_8;
constinit const Stage affine_8{
    {.axis = "interpolate",
     .name = "affine_8",
     .blurb = "exact every 8 pixels, straight between: 1/8000 of the range where distances double",
     .source = "Hecker 1995",
     .kind = Kind::rung},
    Pass::interpolation,
    {.primitive = true},
    [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(affine_8_run, block, frame); }};

} // namespace scanout::shade::interpolate
#endif
