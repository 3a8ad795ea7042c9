// Eight by eight squares a turn, light and dark. A pixel shows the mean over its span, exactly: the
// integral of a square wave is a triangle wave, so no square flickers however small it is.
// Peachey 1994, [Compendium 11.2].
#include "shade/stage.h"

#define SIMD_FILE "shade/source/checker.cpp"
#include "simd/for_each_target.h"

#include "shade/source/lattice-inl.h"

SIMD_BEGIN(scanout::shade::source)

constexpr float kSquares = 8; // a turn, along u and along v
constexpr float kLight = 0.8F, kDark = 0.1F;

// Integral from 0 of the wave that is 1 in even squares and -1 in odd ones; of period 2.
SIMD_INLINE F32 triangle_wave(F32 x) {
    const F32 half = x * F32(0.5F);
    return F32(1.0F) - abs(F32(1.0F) - F32(2.0F) * (half - to_f32(floor_to_int(half))));
}

// Mean of the wave from x - w/2 to x + w/2.
SIMD_INLINE F32 mean_wave(F32 x, F32 width) {
    const F32 w = minimum(maximum(width, F32(0x1p-10F)), F32(0x1p20F)), half = w * F32(0.5F);
    return (triangle_wave(x + half) - triangle_wave(x - half)) / w;
}

void checker_sample(ShadingBlock& b) {
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 squares = kSquares;
        const F32 u = mean_wave(turn(load<F32>(b.u + i)) * squares,
                                span(load<F32>(b.u_x + i), load<F32>(b.u_y + i)) * squares);
        const F32 v = mean_wave(turn(load<F32>(b.v + i)) * squares,
                                span(load<F32>(b.v_x + i), load<F32>(b.v_y + i)) * squares);
        store_grey(b, i, F32((kLight + kDark) / 2) - (u * v) * F32((kLight - kDark) / 2));
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::source {

SIMD_REGISTER(checker_sample);

extern const Source checker;
constinit const Source checker{{.axis = "source",
                                .name = "checker",
                                .blurb = "squares, exactly filtered at any distance",
                                .source = "Peachey 1994",
                                .kind = Kind::model},
                               {.uv = true, .footprint = true},
                               [](ShadingBlock& block) { SIMD_CALL(checker_sample, block); }};

} // namespace scanout::shade::source
#endif
