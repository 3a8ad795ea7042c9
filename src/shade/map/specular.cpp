// map_Ks: the highlight's colour times a texture. Wavefront 1995, [Compendium 11.2].
#include "shade/stage.h"

#define SIMD_FILE "shade/map/specular.cpp"
#include "simd/for_each_target.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade::map)

void specular_run(ShadingBlock& b) {
    const Vec3& ks = b.material->specular;
    const float own[3] = {ks.x, ks.y, ks.z};
    for (int c = 0; c < 3; ++c)
        for (int i = 0; i < b.count; i += kLanes)
            store(F32(own[c]) * load<F32>(b.sampled[c] + i), b.specular[c] + i);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::map {

SIMD_REGISTER(specular_run);

extern const Stage specular;
constinit const Stage specular{{.axis = "map",
                                .name = "specular",
                                .blurb = "map_Ks: the highlight's colour times a texture",
                                .source = "Wavefront 1995",
                                .kind = Kind::effect},
                               Pass::maps,
                               {.uv = true, .maps = bit_of(kSpecularMap)},
                               [](ShadingBlock& block, const FrameState& frame) {
                                   const BoundMap& map = block.map[kSpecularMap];
                                   if (map.texture == nullptr) return;
                                   frame.filter->sample(block, map, TexelKind::data);
                                   SIMD_CALL(specular_run, block);
                               }};

} // namespace scanout::shade::map
#endif
