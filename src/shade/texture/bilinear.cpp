// Bilinear filtering: the four nearest texels, weighted by the overlap of a texel-sized square
// around the sample, in linear light. Heckbert 1989, [Compendium 3.3], [Primer 9].
#include "shade/stage.h"

#define SIMD_FILE "shade/texture/bilinear.cpp"
#include "simd/for_each_target.h"

#include "shade/mip/texel-inl.h"

SIMD_BEGIN(scanout::shade::texture)

template <int kChannels>
SIMD_INLINE void bilinear_lanes(ShadingBlock& b, const TexelReader& reader) {
    for (int i = 0; i < b.count; i += kLanes) {
        const BilinearTaps at =
            bilinear_taps(reader, reader.unit_x(reader.repeats_x(load<F32>(b.u + i))),
                          reader.unit_y(reader.repeats_y(load<F32>(b.v + i))));
        store_sample(blend<kChannels>(reader, at), b, i);
    }
}

void bilinear_sample(ShadingBlock& b, const BoundMap& map, TexelKind kind) {
    const TexelReader reader(map, kind);
    if (kind == TexelKind::alpha)
        bilinear_lanes<1>(b, reader);
    else
        bilinear_lanes<3>(b, reader);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::texture {

SIMD_REGISTER(bilinear_sample);

extern const Filter bilinear;
constinit const Filter bilinear{{.axis = "texture",
                                 .name = "bilinear",
                                 .blurb = "four texels, weighted by overlap, in linear light",
                                 .source = "Heckbert 1989",
                                 .kind = Kind::rung},
                                {.uv = true},
                                [](ShadingBlock& block, const BoundMap& map, TexelKind kind) {
                                    SIMD_CALL(bilinear_sample, block, map, kind);
                                }};

} // namespace scanout::shade::texture
#endif
