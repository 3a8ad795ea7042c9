// Trilinear filtering: bilinear in the two levels of detail around the pixel's size, and linear
// between them, so that no line shows where they change. The pixel's footprint counts as a circle
// as wide as its longer side: slanted surfaces blur. Williams, "Pyramidal Parametrics", 1983;
// [A 3.3], [C 9].
#include "shade/stage.h"

#define SIMD_FILE "shade/texture/trilinear.cpp"
#include "simd/for_each_target.h"

#include "shade/mip-inl.h"

SIMD_BEGIN(scanout::shade::texture)

template <int kChannels>
HWY_INLINE void trilinear_lanes(Block& b, const MipReader& reader) {
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 level = level_of_detail(reader.slopes(b, i));
        const F32 s = reader.image().turns_x(load<F32>(b.u + i));
        const F32 t = reader.image().turns_y(load<F32>(b.v + i));
        store_sample(reader.trilinear<kChannels>(
                         s, t, minimum(maximum(level, F32(0.0F)), F32(reader.last()))),
                     b, i);
    }
}

void trilinear_sample(Block& b, const BoundMap& map, TexelKind kind) {
    const MipReader reader(map, kind);
    if (kind == TexelKind::alpha)
        trilinear_lanes<1>(b, reader);
    else
        trilinear_lanes<3>(b, reader);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::texture {

SIMD_REGISTER(trilinear_sample);

extern const Filter trilinear;
constinit const Filter trilinear{
    {.axis = "texture",
     .name = "trilinear",
     .blurb = "bilinear in the two nearest levels of detail, linear between them",
     .source = "Williams 1983, [A 3.3]",
     .kind = Kind::rung},
    {.uv = true, .footprint = true},
    [](Block& block, const BoundMap& map, TexelKind kind) {
        SIMD_CALL(trilinear_sample)(block, map, kind);
    }};

} // namespace scanout::shade::texture
#endif
