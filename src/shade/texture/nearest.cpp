// Nearest texel: the one that the sample falls into. Heckbert 1989, [Compendium 3.3], [Primer 9].
#include "shade/stage.h"

#define SIMD_FILE "shade/texture/nearest.cpp"
#include "simd/for_each_target.h"

#include "shade/mip/texel-inl.h"

SIMD_BEGIN(scanout::shade::texture)

template <int kChannels>
SIMD_INLINE void nearest_lanes(ShadingBlock& b, const TexelReader& reader) {
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 x = reader.x(load<F32>(b.u + i)), y = reader.y(load<F32>(b.v + i));
        const I32 place = reader.row(floor_to_int(y)) + reader.column(floor_to_int(x));
        store_sample(reader.read<kChannels>(place), b, i);
    }
}

void nearest_sample(ShadingBlock& b, const BoundMap& map, TexelKind kind) {
    const TexelReader reader(map, kind);
    if (kind == TexelKind::alpha)
        nearest_lanes<1>(b, reader);
    else
        nearest_lanes<3>(b, reader);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::texture {

SIMD_REGISTER(nearest_sample);

extern const Filter nearest;
constinit const Filter nearest{{.axis = "texture",
                                .name = "nearest",
                                .blurb = "the texel that the sample falls into",
                                .source = "Heckbert 1989",
                                .kind = Kind::rung},
                               {.uv = true},
                               [](ShadingBlock& block, const BoundMap& map, TexelKind kind) {
                                   SIMD_CALL(nearest_sample, block, map, kind);
                               }};

} // namespace scanout::shade::texture
#endif
