// map_Pm: how much of a physical material is metal, times a texture: paint that flakes
// off. MTL's physical additions; Burley 2012.
#include "shade/map/scalar.h"

#define SIMD_FILE "shade/map/metalness.cpp"
#include "simd/for_each_target.h"

#include "shade/map/scalar-inl.h"

SIMD_BEGIN(scanout::shade::map)

void metalness_run(ShadingBlock& b) {
    const F32 own = scene::metalness_of(*b.material);
    for (int i = 0; i < b.count; i += kLanes)
        store(own * scalar_at(b, b.map[kMetalnessMap], i), b.metalness + i);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::map {

SIMD_REGISTER(metalness_run);

extern const Stage metalness;
constinit const Stage metalness{{.axis = "map",
                                 .name = "metalness",
                                 .blurb = "map_Pm: the share of metal times a texture",
                                 .source = "Burley 2012",
                                 .kind = Kind::effect},
                                Pass::maps,
                                {.uv = true, .maps = bit_of(kMetalnessMap)},
                                [](ShadingBlock& block, const FrameState& frame) {
                                    const BoundMap& map = block.map[kMetalnessMap];
                                    if (map.texture == nullptr) return;
                                    frame.filter->sample(block, map, scalar_kind(map));
                                    SIMD_CALL(metalness_run, block);
                                }};

} // namespace scanout::shade::map
#endif
