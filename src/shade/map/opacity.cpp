// Alpha: d of the material, times map_d, times the alpha channel of map_Kd. Wavefront 1995,
// [Primer 1.6].
#include "shade/stage.h"

#define SIMD_FILE "shade/map/opacity.cpp"
#include "simd/for_each_target.h"

#include "simd/lanes-inl.h"

SIMD_BEGIN(scanout::shade::map)

void opacity_set(ShadingBlock& b, float opacity) {
    for (int i = 0; i < b.count; i += kLanes)
        store(F32(opacity), b.alpha + i);
}

// channel: of MTL's -imfchan; m is the alpha channel, l the luminance.
void opacity_multiply(ShadingBlock& b, char channel) {
    const int one = channel == 'm' ? 3 : channel == 'g' ? 1 : channel == 'b' ? 2 : 0;
    for (int i = 0; i < b.count; i += kLanes) {
        F32 factor = load<F32>(b.sampled[one] + i);
        if (channel == 'l') { // of grey: the grey itself
            const F32 red = factor, green = load<F32>(b.sampled[1] + i),
                      blue = load<F32>(b.sampled[2] + i);
            factor = green + (F32(0.2126F) * (red - green) + F32(0.0722F) * (blue - green));
        }
        factor = minimum(maximum(factor, F32(0.0F)), F32(1.0F));
        store(load<F32>(b.alpha + i) * factor, b.alpha + i);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::map {

SIMD_REGISTER(opacity_set);
SIMD_REGISTER(opacity_multiply);

namespace {

void opacity_run(ShadingBlock& block, const FrameState& frame) {
    SIMD_CALL(opacity_set, block, block.material->opacity);
    const BoundMap& opacity = block.map[kOpacityMap];
    if (opacity.texture != nullptr) {
        const char given = opacity.map->channel;
        const char channel =
            given == 'r' || given == 'g' || given == 'b' || given == 'm' ? given : 'l';
        frame.filter->sample(block, opacity, channel == 'm' ? TexelKind::alpha : TexelKind::data);
        SIMD_CALL(opacity_multiply, block, channel);
    }
    const BoundMap& diffuse = block.map[kDiffuseMap];
    if (diffuse.texture != nullptr) {
        frame.filter->sample(block, diffuse, TexelKind::alpha);
        SIMD_CALL(opacity_multiply, block, 'm');
    }
}

} // namespace

extern const Stage opacity;
constinit const Stage opacity{{.axis = "map",
                               .name = "opacity",
                               .blurb = "d, times map_d, times the alpha channel of map_Kd",
                               .source = "Wavefront 1995",
                               .kind = Kind::effect},
                              Pass::maps,
                              {.uv = true, .maps = bit_of(kDiffuseMap) | bit_of(kOpacityMap)},
                              opacity_run};

} // namespace scanout::shade::map
#endif
