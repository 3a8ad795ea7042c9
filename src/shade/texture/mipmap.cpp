// Mipmapping: the level whose texels are about as large as the pixel, and bilinear in it. No more
// than four texels are read at any distance; where the level changes, a line shows. Williams 1983,
// [Primer 9].
#include "shade/stage.h"

#define SIMD_FILE "shade/texture/mipmap.cpp"
#include "simd/for_each_target.h"

#include "shade/mip/mip-inl.h"

SIMD_BEGIN(scanout::shade::texture)

template <int kChannels>
SIMD_INLINE void mipmap_lanes(ShadingBlock& b, const MipReader& reader) {
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 level = level_of_detail(reader.slopes(b, i)) + F32(0.5F);
        const I32 nearest =
            to_i32(minimum(maximum(level, F32(0.0F)), F32(reader.last()))); // last is whole
        const F32 s = reader.image().repeats_x(load<F32>(b.u + i));
        const F32 t = reader.image().repeats_y(load<F32>(b.v + i));
        store_sample(reader.bilinear<kChannels>(s, t, nearest), b, i);
    }
}

void mipmap_sample(ShadingBlock& b, const BoundMap& map, TexelKind kind) {
    const MipReader reader(map, kind);
    if (kind == TexelKind::alpha)
        mipmap_lanes<1>(b, reader);
    else
        mipmap_lanes<3>(b, reader);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::texture {

SIMD_REGISTER(mipmap_sample);

extern const Filter mipmap;
constinit const Filter mipmap{
    {.axis = "texture",
     .name = "mipmap",
     .blurb = "bilinear in the level of detail that is nearest to the pixel's size",
     .source = "Williams 1983",
     .kind = Kind::rung,
     .may_err_more =
         {"nearest bilinear",
          "it blurs over two pixels, and along slanted surfaces over more: where a texture is "
          "flat but for sharp edges, one point of it is right more often"}},
    {.uv = true, .footprint = true},
    [](ShadingBlock& block, const BoundMap& map, TexelKind kind) {
        SIMD_CALL(mipmap_sample, block, map, kind);
    }};

} // namespace scanout::shade::texture
#endif
