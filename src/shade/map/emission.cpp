// Emission: Ke times map_Ke, light that the surface gives off by itself. It lights no other
// surface. A common addition to MTL.
#include "shade/stage.h"

#define SIMD_FILE "shade/map/emission.cpp"
#include "simd/for_each_target.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade::map)

void emission_run(ShadingBlock& b, bool mapped) {
    const Vec3& ke = b.material->emission;
    const float own[3] = {ke.x, ke.y, ke.z};
    for (int c = 0; c < 3; ++c)
        for (int i = 0; i < b.count; i += kLanes) {
            const F32 light = mapped ? F32(own[c]) * load<F32>(b.sampled[c] + i) : F32(own[c]);
            store(load<F32>(b.colour[c] + i) + light, b.colour[c] + i);
        }
}

// A surface without light shows its albedo in place of what it reflects.
void unlit_run(ShadingBlock& b) {
    for (int c = 0; c < 3; ++c)
        for (int i = 0; i < b.count; i += kLanes)
            store(load<F32>(b.albedo[c] + i), b.colour[c] + i);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::map {

SIMD_REGISTER(emission_run);
SIMD_REGISTER(unlit_run);

extern const Stage emission;
constinit const Stage emission{{.axis = "map",
                                .name = "emission",
                                .blurb = "Ke and map_Ke: light of the surface's own",
                                .source = "Segal and Akeley 1992",
                                .kind = Kind::effect},
                               Pass::emission,
                               {},
                               [](ShadingBlock& block, const FrameState& frame) {
                                   if (!block.lit) return;
                                   if (block.material->unlit) SIMD_CALL(unlit_run, block);
                                   if (block.material->emission == Vec3(0)) return;
                                   const BoundMap& map = block.map[kEmissionMap];
                                   const bool mapped = map.texture != nullptr;
                                   if (mapped) frame.filter->sample(block, map, TexelKind::colour);
                                   SIMD_CALL(emission_run, block, mapped);
                               }};

} // namespace scanout::shade::map
#endif
