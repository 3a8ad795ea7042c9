// Bilinear filtering: the four nearest texels, weighted by the overlap of a texel-sized square
// around the sample, in linear light. Heckbert, "Fundamentals of Texture Mapping", 1989; [A 3.3],
// [C 9].
#include "shade/stage.h"

#define SIMD_FILE "shade/texture/bilinear.cpp"
#include "simd/for_each_target.h"

#include "shade/texel-inl.h"

SIMD_BEGIN(scanout::shade::texture)

HWY_INLINE F32 mix(F32 share, F32 from, F32 to) {
    return from + share * (to - from);
}

template <bool kAlpha>
HWY_INLINE void bilinear(Block& b, const TexelReader& reader) {
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 x = reader.x(load<F32>(b.u + i)) - F32(0.5F);
        const F32 y = reader.y(load<F32>(b.v + i)) - F32(0.5F);
        const I32 x0 = floor_to_int(x), y0 = floor_to_int(y);
        const F32 fx = x - to_f32(x0), fy = y - to_f32(y0);
        const I32 left = reader.column(x0), right = reader.column(x0 + I32(1));
        const I32 bottom = reader.row(y0), top = reader.row(y0 + I32(1));
        const Texel t00 = reader.read<kAlpha>(left, bottom),
                    t10 = reader.read<kAlpha>(right, bottom);
        const Texel t01 = reader.read<kAlpha>(left, top), t11 = reader.read<kAlpha>(right, top);
        for (int c = kFirstChannel<kAlpha>; c < kEndChannel<kAlpha>; ++c) {
            const F32 lower = mix(fx, t00.channel[c], t10.channel[c]);
            const F32 upper = mix(fx, t01.channel[c], t11.channel[c]);
            store(mix(fy, lower, upper), b.sampled[c] + i);
        }
    }
}

void bilinear_sample(Block& b, const BoundMap& map, TexelKind kind) {
    const TexelReader reader(map, kind);
    if (kind == TexelKind::alpha)
        bilinear<true>(b, reader);
    else
        bilinear<false>(b, reader);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::texture {

SIMD_REGISTER(bilinear_sample);

extern const Filter bilinear;
constinit const Filter bilinear{{.axis = "texture",
                                 .name = "bilinear",
                                 .blurb = "four texels, weighted by overlap, in linear light",
                                 .source = "Heckbert 1989, [A 3.3]",
                                 .kind = Kind::rung},
                                {.uv = true},
                                [](Block& block, const BoundMap& map, TexelKind kind) {
                                    SIMD_CALL(bilinear_sample)(block, map, kind);
                                }};

} // namespace scanout::shade::texture
#endif
