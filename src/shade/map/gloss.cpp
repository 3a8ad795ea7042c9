// map_Ns: the highlight's exponent times a texture, so that parts of a surface shine sharper than
// others. Wavefront 1995, [Compendium 11.2].
#include "shade/map/scalar.h"

#define SIMD_FILE "shade/map/gloss.cpp"
#include "simd/for_each_target.h"

#include "shade/map/scalar-inl.h"

SIMD_BEGIN(scanout::shade::map)

void gloss_run(ShadingBlock& b) {
    const F32 own = b.material->shininess, nothing = 0.0F;
    for (int i = 0; i < b.count; i += kLanes)
        store(maximum(own * scalar_at(b, b.map[kShininessMap], i), nothing), b.shininess + i);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::map {

SIMD_REGISTER(gloss_run);

extern const Stage gloss;
constinit const Stage gloss{
    {.axis = "map",
     .name = "gloss",
     .blurb = "map_Ns: the highlight's exponent times a texture; black is dull",
     .source = "Wavefront 1995",
     .kind = Kind::effect},
    Pass::maps,
    {.uv = true, .maps = bit_of(kShininessMap)},
    [](ShadingBlock& block, const FrameState& frame) {
        const BoundMap& map = block.map[kShininessMap];
        if (map.texture == nullptr) return;
        frame.filter->sample(block, map, scalar_kind(map));
        SIMD_CALL(gloss_run, block);
    }};

} // namespace scanout::shade::map
#endif
