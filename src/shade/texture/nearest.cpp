// Nearest texel: the one that the sample falls into. [A 3.3], [C 9].
#include "shade/stage.h"

#define SIMD_FILE "shade/texture/nearest.cpp"
#include "simd/for_each_target.h"

#include "shade/texel-inl.h"

SIMD_BEGIN(scanout::shade::texture)

template <bool kAlpha>
HWY_INLINE void nearest(Block& b, const TexelReader& reader) {
    for (int i = 0; i < b.count; i += kLanes) {
        const F32 x = reader.x(load<F32>(b.u + i)), y = reader.y(load<F32>(b.v + i));
        const Texel texel =
            reader.read<kAlpha>(reader.column(floor_to_int(x)), reader.row(floor_to_int(y)));
        for (int c = kFirstChannel<kAlpha>; c < kEndChannel<kAlpha>; ++c)
            store(texel.channel[c], b.sampled[c] + i);
    }
}

void nearest_sample(Block& b, const BoundMap& map, TexelKind kind) {
    const TexelReader reader(map, kind);
    if (kind == TexelKind::alpha)
        nearest<true>(b, reader);
    else
        nearest<false>(b, reader);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::texture {

SIMD_REGISTER(nearest_sample);

extern const Filter nearest;
constinit const Filter nearest{{.axis = "texture",
                                .name = "nearest",
                                .blurb = "the texel that the sample falls into",
                                .source = "[A 3.3]",
                                .kind = Kind::rung},
                               {.uv = true},
                               [](Block& block, const BoundMap& map, TexelKind kind) {
                                   SIMD_CALL(nearest_sample)(block, map, kind);
                               }};

} // namespace scanout::shade::texture
#endif
