// Bicubic filtering for magnified textures: sixteen texels, weighted by cubic convolution along
// each axis (Keys 1981, a = -1/2: the Catmull-Rom spline), in linear light. It passes through every
// texel and bends smoothly in between, where bilinear has a crease at each texel. The spline
// overshoots beside an edge, which shows as a halo (Mitchell and Netravali 1988); so the result is
// held within the four texels around the sample. Four times the texels of bilinear, and no better
// where textures are minified.
#include "shade/stage.h"

#define SIMD_FILE "shade/texture/bicubic.cpp"
#include "simd/for_each_target.h"

#include "shade/mip/texel-inl.h"

SIMD_BEGIN(scanout::shade::texture)

// The weights of the first, third and fourth of four texels in a row, t of the way from the second
// to the third; the second has the rest to 1.
struct CubicWeights {
    F32 first, third, fourth;
};
SIMD_INLINE CubicWeights cubic_weights(F32 t) {
    const F32 half = 0.5F;
    return {t * (t * (F32(1.0F) - half * t) - half), t * (half + t * (F32(2.0F) - F32(1.5F) * t)),
            t * t * (half * t - half)};
}

// Sums differences from the second texel, so that equal texels give that texel, to the bit.
template <int kChannels>
SIMD_INLINE Texel<kChannels> convolve(const CubicWeights& w, const Texel<kChannels> (&p)[4]) {
    Texel<kChannels> sum;
    for (int c = 0; c < kChannels; ++c) {
        const F32 base = p[1].channel[c];
        sum.channel[c] =
            base + ((w.first * (p[0].channel[c] - base) + w.third * (p[2].channel[c] - base)) +
                    w.fourth * (p[3].channel[c] - base));
    }
    return sum;
}

// Clamps to the range of the four inner texels.
template <int kChannels>
SIMD_INLINE Texel<kChannels> limited(const Texel<kChannels>& sum,
                                     const Texel<kChannels> (&p)[4][4]) {
    Texel<kChannels> held;
    for (int c = 0; c < kChannels; ++c) {
        const F32 a = p[1][1].channel[c], b = p[1][2].channel[c], d = p[2][1].channel[c],
                  e = p[2][2].channel[c];
        const F32 low = minimum(minimum(a, b), minimum(d, e)),
                  high = maximum(maximum(a, b), maximum(d, e));
        held.channel[c] = minimum(maximum(sum.channel[c], low), high);
    }
    return held;
}

template <int kChannels>
SIMD_INLINE Texel<kChannels> bicubic(const TexelReader& reader, F32 s, F32 t) {
    const I32 width = reader.width(), height = reader.height();
    const F32 x = s * to_f32(width) - F32(0.5F), y = t * to_f32(height) - F32(0.5F);
    const F32 x0 = floor(x), y0 = floor(y);
    // A one-texel texture: indices may lie two sides beyond an edge, and address() covers one.
    const auto within = [](I32 i, I32 size)
                            SIMD_LAMBDA { return minimum(maximum(i, I32(0)), size - I32(1)); };
    I32 column[4], line[4];
    for (int k = 0; k < 4; ++k) {
        column[k] = within(reader.address_x(to_i32(x0) + I32(k - 1), width), width);
        line[k] = within(reader.address_y(to_i32(y0) + I32(k - 1), height), height);
    }
    Texel<kChannels> p[4][4], row[4];
    const CubicWeights across = cubic_weights(x - x0), up = cubic_weights(y - y0);
    for (int j = 0; j < 4; ++j) {
        const I32 begin = (height - I32(1) - line[j]) * width; // rows run down
        for (int i = 0; i < 4; ++i)
            p[j][i] = reader.read<kChannels>(begin + column[i]);
        row[j] = convolve(across, p[j]);
    }
    return limited(convolve(up, row), p);
}

template <int kChannels>
SIMD_INLINE void bicubic_lanes(ShadingBlock& b, const TexelReader& reader) {
    for (int i = 0; i < b.count; i += kLanes)
        store_sample(bicubic<kChannels>(reader, reader.unit_x(reader.repeats_x(load<F32>(b.u + i))),
                                        reader.unit_y(reader.repeats_y(load<F32>(b.v + i)))),
                     b, i);
}

void bicubic_sample(ShadingBlock& b, const BoundMap& map, TexelKind kind) {
    const TexelReader reader(map, kind);
    if (kind == TexelKind::alpha)
        bicubic_lanes<1>(b, reader);
    else
        bicubic_lanes<3>(b, reader);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::texture {

SIMD_REGISTER(bicubic_sample);

extern const Filter bicubic;
constinit const Filter bicubic{
    {.axis = "texture",
     .name = "bicubic",
     .blurb = "sixteen texels by cubic convolution: smooth where magnified, as bilinear elsewhere",
     .source = "Keys 1981, Mitchell and Netravali 1988",
     .kind = Kind::model},
    {.uv = true},
    [](ShadingBlock& block, const BoundMap& map, TexelKind kind) {
        SIMD_CALL(bicubic_sample, block, map, kind);
    }};

} // namespace scanout::shade::texture
#endif
