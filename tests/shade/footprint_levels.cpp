#include "shade/footprint_levels.h"

#define SIMD_FILE "shade/footprint_levels.cpp"
#include "simd/for_each_target.h"

#include "shade/footprint-inl.h"

SIMD_BEGIN(scanout::shade::texture)

// Arrays have room for whole registers.
void levels_wide(const Primitive& t, double width, double height, const std::int32_t* x,
                 const std::int32_t* y, int count, float* out) {
    const Footprint footprint(t, width, height);
    for (int i = 0; i < count; i += kLanes)
        store(footprint.level(load<I32>(x + i), load<I32>(y + i)), out + i);
}
void levels_narrow(const Primitive& t, double width, double height, const std::int32_t* x,
                   const std::int32_t* y, int count, float* out) {
    const Footprint footprint(t, width, height);
    for (int i = 0; i < count; i += kLanesX8)
        store(footprint.level(load<I32x8>(x + i), load<I32x8>(y + i)), out + i);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::texture {
SIMD_REGISTER(levels_wide);
SIMD_REGISTER(levels_narrow);

static void run(bool narrow, const Primitive& t, double width, double height, const std::int32_t* x,
                const std::int32_t* y, int count, float* out) {
    const auto kernel = narrow ? SIMD_CALL(levels_narrow) : SIMD_CALL(levels_wide);
    kernel(t, width, height, x, y, count, out);
}
} // namespace scanout::shade::texture

namespace scanout::shade::test {

std::vector<float> levels(bool narrow, const Primitive& triangle, double width, double height,
                          const std::vector<Sample>& samples) {
    std::vector<std::int32_t> x(samples.size() + 16), y(samples.size() + 16);
    std::vector<float> out(samples.size() + 16);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        x[i] = samples[i].x;
        y[i] = samples[i].y;
    }
    texture::run(narrow, triangle, width, height, x.data(), y.data(),
                 static_cast<int>(samples.size()), out.data());
    out.resize(samples.size());
    return out;
}

} // namespace scanout::shade::test
#endif
