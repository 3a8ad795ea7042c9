// map_Pr: the roughness of a physical material times a texture: scratches, wear and
// fingerprints are seen by how they spread the light. MTL's physical additions; Burley 2012.
#include "shade/map/scalar.h"

#define SIMD_FILE "shade/map/roughness.cpp"
#include "simd/for_each_target.h"

#include "shade/map/scalar-inl.h"

SIMD_BEGIN(scanout::shade::map)

void roughness_run(ShadingBlock& b) {
    const F32 own = scene::roughness_of(*b.material);
    for (int i = 0; i < b.count; i += kLanes)
        store(own * scalar_at(b, b.map[kRoughnessMap], i), b.roughness + i);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::map {

SIMD_REGISTER(roughness_run);

extern const Stage roughness;
constinit const Stage roughness{{.axis = "map",
                                 .name = "roughness",
                                 .blurb = "map_Pr: the roughness times a texture",
                                 .source = "Burley 2012",
                                 .kind = Kind::effect},
                                Pass::maps,
                                {.uv = true, .maps = bit_of(kRoughnessMap)},
                                [](ShadingBlock& block, const FrameState& frame) {
                                    const BoundMap& map = block.map[kRoughnessMap];
                                    if (map.texture == nullptr) return;
                                    frame.filter->sample(block, map, scalar_kind(map));
                                    SIMD_CALL(roughness_run, block);
                                }};

} // namespace scanout::shade::map
#endif
