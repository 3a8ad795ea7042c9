// Exposure in stops, as a camera's: each stop doubles the light or halves it; the frame's factor is
// 2^stops. Runs before tone mapping, so that the tone curve sees the exposed light.
#include "shade/stage.h"

#define SIMD_FILE "shade/exposure/stops.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::shade::exposure)

void stops_run(ShadingBlock& b, const FrameState& frame) {
    const F32 exposure = frame.exposure;
    for (auto& channel : b.colour)
        for (int i = 0; i < b.count; i += kLanes)
            store(load<F32>(channel + i) * exposure, channel + i);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::exposure {

SIMD_REGISTER(stops_run);

extern const Stage stops;
constinit const Stage stops{
    {.axis = "exposure",
     .name = "stops",
     .blurb = "light times 2^stops, before it is cut off or bent",
     .source = "Reinhard et al. 2002",
     .kind = Kind::effect},
    Pass::exposure,
    {},
    [](ShadingBlock& block, const FrameState& frame) { SIMD_CALL(stops_run, block, frame); }};

} // namespace scanout::shade::exposure
#endif
