// Affine interpolation: linear on the screen, as if all vertices were equally far: textures bend at
// the edges between triangles (HARD-CASES T4). [Compendium 3, 5].
#include "shade/stage.h"

#define SIMD_FILE "shade/interpolate/affine.cpp"
#include "simd/for_each_target.h"

#include "shade/interpolate/affine-inl.h"

SIMD_BEGIN(scanout::shade::interpolate)

struct Affine {
    static constexpr bool kExact = false;
    static SIMD_INLINE void lanes(ShadingBlock& b, const Wanted& want, const Run& run) {
        affine_lanes(b, want, run);
    }
};

void affine_run(ShadingBlock& b, const FrameState& frame) {
    run_rung<Affine>(b, frame);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::interpolate {

SIMD_REGISTER(affine_run);

extern const Stage affine;
constinit const Stage affine{
    {.axis = "interpolate",
     .name = "affine",
     .blurb = "straight on the screen: 1/6 of the range wrong where distances double",
     .source = "Heckbert 1989",
     .kind = Kind::rung},
    Pass::interpolation,
    {.primitive = true},
    [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(affine_run, block, frame); }};

} // namespace scanout::shade::interpolate
#endif
