#include "shade/ambient_occlusion/attenuate.h"

#include "shade/ambient_occlusion.h"

#define SIMD_FILE "shade/ambient_occlusion/attenuate.cpp"
#include "simd/for_each_target.h"

#include "simd/vec3-inl.h"

SIMD_BEGIN(scanout::shade::ambient_occlusion)

// Of an item whose pixel shows another surface at its centre: of the nearest distance among the
// nine around it.
float of_neighbours(const OcclusionImage& image, int x, int y, float distance) {
    float open = 1, least = image.apart;
    for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
            const int column = x + dx, row = y + dy;
            if (column < 0 || row < 0 || column >= image.width || row >= image.height) continue;
            const std::ptrdiff_t at = std::ptrdiff_t{row} * image.stride + column;
            const float apart = image.distance[at] - distance;
            const float away = apart < 0 ? -apart : apart;
            if (!(away < least)) continue;
            least = away;
            open = image.open[at];
        }
    }
    return open;
}

void attenuate_lanes(ShadingBlock& b, const FrameState& frame) {
    const OcclusionImage& image = *frame.occlusion;
    const bool hemispheres = !frame.hemispheres.empty();
    constexpr int kAll = static_cast<int>((1U << kLanes) - 1);
    for (int i = 0; i < b.count; i += kLanes) {
        // Beyond the live items stands whatever there was: kept within the picture.
        const I32 x = minimum(maximum(shift_right<8>(load<I32>(b.x + i)), I32(0)),
                              I32(image.width - 1)),
                  y = minimum(maximum(shift_right<8>(load<I32>(b.y + i)), I32(0)),
                              I32(image.height - 1));
        const I32 at = y * I32(image.stride) + x;
        const F32 distance = F32(0.0F) - load<F32>(b.position[2] + i);
        F32 open = gather(image.open, at);
        const int same = static_cast<int>(
            bits(abs(gather(image.distance, at) - distance) < F32(0.5F * image.apart)));
        if (same != kAll) {
            alignas(64) float shares[kLanes];
            store(open, shares);
            for (int lane = 0; lane < kLanes && i + lane < b.count; ++lane)
                if ((same >> lane & 1) == 0)
                    shares[lane] = of_neighbours(image, b.x[i + lane] >> 8, b.y[i + lane] >> 8,
                                                 -b.position[2][i + lane]);
            open = load<F32>(shares);
        }
        Vec3F32 arrives = everywhere<Vec3F32>(b.ambient);
        if (hemispheres) arrives = arrives + load_vec3<Vec3F32>(b.from_hemispheres, i);
        store_vec3(arrives * open, b.from_hemispheres, i);
    }
    b.ambient = Vec3(0);
    b.hemispheres = true;
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::ambient_occlusion {

SIMD_REGISTER(attenuate_lanes);

void attenuate(ShadingBlock& block, const FrameState& frame) {
    // The block before this one has left it true.
    block.hemispheres = !frame.hemispheres.empty();
    if (block.lit && block.occluded) SIMD_CALL(attenuate_lanes, block, frame);
}

} // namespace scanout::shade::ambient_occlusion
#endif
