// Exposure alone: light times a power of two; what is brighter than 1 then becomes 1, where codes
// are made. Not run where the exposure is 0 stops.
#include "shade/stage.h"

#define SIMD_FILE "shade/tone/clamp.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::shade::tone)

void clamp_run(Block& b, const FrameState& frame) {
    const F32 exposure = frame.exposure;
    for (auto& channel : b.colour)
        for (int i = 0; i < b.count; i += kLanes)
            store(load<F32>(channel + i) * exposure, channel + i);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::tone {

SIMD_REGISTER(clamp_run);

extern const Stage clamp;
constinit const Stage clamp{{.axis = "tone",
                             .name = "clamp",
                             .blurb = "light above 1 is cut off, all below is exact",
                             .source = "MTL's illum models; D3D 11.3 3.2.3.6",
                             .kind = Kind::model},
                            {},
                            [](Block& block, const FrameState& frame) {
                                SIMD_CALL(clamp_run)(block, frame);
                            }};

} // namespace scanout::shade::tone
#endif
