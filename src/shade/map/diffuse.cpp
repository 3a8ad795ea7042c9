// map_Kd: the material's diffuse colour times the texture's, or times the computed texture that the
// user chose instead. Catmull 1974, [Compendium 11.2], [Primer 9].
#include "shade/stage.h"

#define SIMD_FILE "shade/map/diffuse.cpp"
#include "simd/for_each_target.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade::map)

void diffuse_run(ShadingBlock& b) {
    for (int c = 0; c < 3; ++c)
        for (int i = 0; i < b.count; i += kLanes)
            store(load<F32>(b.albedo[c] + i) * load<F32>(b.sampled[c] + i), b.albedo[c] + i);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::map {

SIMD_REGISTER(diffuse_run);

extern const Stage diffuse;
constinit const Stage diffuse{{.axis = "map",
                               .name = "diffuse",
                               .blurb = "map_Kd: the diffuse colour times a texture",
                               .source = "Catmull 1974",
                               .kind = Kind::effect},
                              Pass::maps,
                              {.uv = true, .maps = bit_of(kDiffuseMap)},
                              [](ShadingBlock& block, const FrameState& frame) {
                                  const BoundMap& map = block.map[kDiffuseMap];
                                  if (frame.source != nullptr && block.lit)
                                      frame.source->sample(block);
                                  else if (map.texture != nullptr)
                                      frame.filter->sample(block, map, TexelKind::colour);
                                  else
                                      return;
                                  SIMD_CALL(diffuse_run, block);
                              }};

} // namespace scanout::shade::map
#endif
