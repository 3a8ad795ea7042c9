// Improved noise, smooth, with lumps of one size, the same everywhere: Perlin 2002, in the plane z
// = 0. Four octaves, each with lumps half as large and half as strong, from eight lumps a turn on;
// it repeats every turn. An octave whose lumps are smaller than two pixels fades out, since a pixel
// cannot show it. [Compendium 11.2], [Primer 9.3].
#include "shade/source/permutation.h"
#include "shade/stage.h"

#define SIMD_FILE "shade/source/perlin_noise.cpp"
#include "simd/for_each_target.h"

#include "shade/source/lattice-inl.h"

SIMD_BEGIN(scanout::shade::source)

SIMD_INLINE F32 fade(F32 t) {
    return t * t * t * (t * (t * F32(6.0F) - F32(15.0F)) + F32(10.0F));
}

// One of twelve directions times the offset (x, y, 0).
SIMD_INLINE F32 gradient(I32 hash, F32 x, F32 y) {
    const I32 h = hash & I32(15);
    const F32 u = select(h < I32(8), x, y);
    const F32 v = select(h < I32(4), y, select((h == I32(12)) | (h == I32(14)), x, F32(0.0F)));
    return select((h & I32(1)) == I32(0), u, -u) + select((h & I32(2)) == I32(0), v, -v);
}

// At (x, y) >= 0 on a lattice that repeats after `period` cells, a power of two up to 256.
SIMD_INLINE F32 noise(F32 x, F32 y, int period) {
    const I32 x0 = floor_to_int(x), y0 = floor_to_int(y), mask = period - 1;
    const F32 fx = x - to_f32(x0), fy = y - to_f32(y0), one = 1.0F;
    const std::int32_t* p = kPermutationTwice.data();
    const I32 left = gather(p, x0 & mask), right = gather(p, (x0 + I32(1)) & mask);
    const I32 below = y0 & mask, above = (y0 + I32(1)) & mask;
    const auto corner = [&](I32 column, I32 row) SIMD_LAMBDA {
        return gather(p, gather(p, column + row)); // z = 0
    };
    const F32 t = fade(fx);
    using texture::HWY_NAMESPACE::mix;
    return mix(
        fade(fy),
        mix(t, gradient(corner(left, below), fx, fy), gradient(corner(right, below), fx - one, fy)),
        mix(t, gradient(corner(left, above), fx, fy - one),
            gradient(corner(right, above), fx - one, fy - one)));
}

void perlin_noise_sample(ShadingBlock& b) {
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 u = turn(load<F32>(b.u + i)), v = turn(load<F32>(b.v + i));
        const F32 pixel = maximum(span(load<F32>(b.u_x + i), load<F32>(b.u_y + i)),
                                  span(load<F32>(b.v_x + i), load<F32>(b.v_y + i)));
        F32 sum = 0.0F;
        float strength = 0.5F;
        for (int period = 8; period <= 64; period *= 2) {
            const F32 lumps = static_cast<float>(period);
            const F32 shown = F32(2.0F) - F32(2.0F) * (pixel * lumps);
            sum = sum + (noise(u * lumps, v * lumps, period) *
                         minimum(maximum(shown, F32(0.0F)), F32(1.0F))) *
                            F32(strength);
            strength = strength * 0.5F;
        }
        store_grey(b, i, minimum(maximum(F32(0.5F) + sum, F32(0.0F)), F32(1.0F)));
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::source {

SIMD_REGISTER(perlin_noise_sample);

extern const Source perlin_noise;
constinit const Source perlin_noise{
    {.axis = "source",
     .name = "perlin_noise",
     .blurb = "four octaves of smooth lumps",
     .source = "Perlin 1985, Perlin 2002",
     .kind = Kind::model},
    {.uv = true, .footprint = true},
    [](ShadingBlock& block) { SIMD_CALL(perlin_noise_sample, block); }};

} // namespace scanout::shade::source
#endif
