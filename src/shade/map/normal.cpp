// Normal mapping (norm, map_Kn): a texture gives the normal, red along growing u, green along
// growing v, blue away from the surface; code 128 is 0. Cohen, Olano and Manocha 1998, [Compendium
// 11.2].
#include "shade/stage.h"

#define SIMD_FILE "shade/map/normal.cpp"
#include "simd/for_each_target.h"

#include "shade/map/tangent-inl.h"

SIMD_BEGIN(scanout::shade::map)

void normal_run(ShadingBlock& b, const FrameState& frame) {
    write_tangents(b, frame);
    const scene::TextureMap& map = *b.map[kNormalMap].map;
    // A negative scale mirrors the texture in u or v, and its normals with it.
    const float leaning = map.normal_scale;
    const F32 along_u = map.scale.x < 0 ? -leaning : leaning,
              along_v = map.scale.y < 0 ? -leaning : leaning;
    const F32 middle = 128.0F / 255.0F;
    for (int i = 0; i < b.count; i += kLanes) {
        const Vec3F32 given = {(load<F32>(b.sampled[0] + i) - middle) * along_u,
                               (load<F32>(b.sampled[1] + i) - middle) * along_v,
                               maximum(load<F32>(b.sampled[2] + i) - middle, F32(0.0F))};
        lean_normal(b, i, given);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::map {

SIMD_REGISTER(normal_run);

extern const Stage normal;
constinit const Stage normal{{.axis = "map",
                              .name = "normal",
                              .blurb = "norm: a texture gives the surface's normal",
                              .source = "Cohen, Olano and Manocha 1998",
                              .kind = Kind::effect},
                             Pass::maps,
                             {.normal = true,
                              .uv = true,
                              .ray = true,
                              .facing = true,
                              .footprint = true,
                              .maps = bit_of(kNormalMap)},
                             [](ShadingBlock& block, const FrameState& frame) {
                                 const BoundMap& map = block.map[kNormalMap];
                                 if (map.texture == nullptr) return;
                                 frame.filter->sample(block, map, TexelKind::data);
                                 SIMD_CALL(normal_run, block, frame);
                             }};

} // namespace scanout::shade::map
#endif
