// White noise: 64 by 64 cells a turn; the hash of its place is the brightness of a cell, the same
// everywhere. A pixel that spans several cells shows their mean, which is nearer to the middle by
// the root of their number. Peachey 1994, [Primer 9.3].
#include "shade/stage.h"

#define SIMD_FILE "shade/source/white_noise.cpp"
#include "simd/for_each_target.h"

#include "shade/source/lattice-inl.h"

SIMD_BEGIN(scanout::shade::source)

constexpr int kCells = 64; // a turn

void white_noise_sample(ShadingBlock& b) {
    const F32 cells = static_cast<float>(kCells);
    for (int i = 0; i < b.count; i += kLanes) {
        const I32 most = kCells - 1;
        const I32 x = minimum(to_i32(turn(load<F32>(b.u + i)) * cells), most);
        const I32 y = minimum(to_i32(turn(load<F32>(b.v + i)) * cells), most);
        const I32 bits = shifted_down<8>(hash(x + y * I32(kCells) + I32(1)));
        const F32 value = to_f32(bits) * F32(0x1p-24F);
        const F32 wide = maximum(span(load<F32>(b.u_x + i), load<F32>(b.u_y + i)) * cells, 1.0F);
        const F32 high = maximum(span(load<F32>(b.v_x + i), load<F32>(b.v_y + i)) * cells, 1.0F);
        store_grey(b, i, F32(0.5F) + (value - F32(0.5F)) / sqrt(wide * high));
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::source {

SIMD_REGISTER(white_noise_sample);

extern const Source white_noise;
constinit const Source white_noise{
    {.axis = "source",
     .name = "white_noise",
     .blurb = "cells of random brightness, by hash",
     .source = "Peachey 1994",
     .kind = Kind::model},
    {.uv = true, .footprint = true},
    [](ShadingBlock& block) { SIMD_CALL(white_noise_sample, block); }};

} // namespace scanout::shade::source
#endif
