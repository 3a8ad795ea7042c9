#include "shade/footprint_levels.h"

#define SIMD_FILE "shade/footprint_levels.cpp"
#include "simd/for_each_target.h"

#include "shade/footprint-inl.h"

SIMD_BEGIN(scanout::shade::texture)

// Arrays have room for whole registers.
template <class Place>
HWY_INLINE void levels_of(const Primitive& t, float width, float height, const std::int32_t* x,
                          const std::int32_t* y, int count, float* out) {
    const Footprint footprint(t);
    for (int i = 0; i < count; i += static_cast<int>(Place::kLanes)) {
        auto slopes = footprint.slopes(load<Place>(x + i), load<Place>(y + i));
        slopes.u_x = slopes.u_x * width;
        slopes.v_x = slopes.v_x * height;
        slopes.u_y = slopes.u_y * width;
        slopes.v_y = slopes.v_y * height;
        store(level_of_detail(slopes), out + i);
    }
}
void levels_wide(const Primitive& t, float width, float height, const std::int32_t* x,
                 const std::int32_t* y, int count, float* out) {
    levels_of<I32>(t, width, height, x, y, count, out);
}
void levels_narrow(const Primitive& t, float width, float height, const std::int32_t* x,
                   const std::int32_t* y, int count, float* out) {
    levels_of<I32x8>(t, width, height, x, y, count, out);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::texture {
SIMD_REGISTER(levels_wide);
SIMD_REGISTER(levels_narrow);

static void run(bool narrow, const Primitive& t, float width, float height, const std::int32_t* x,
                const std::int32_t* y, int count, float* out) {
    const auto kernel = narrow ? SIMD_CALL(levels_narrow) : SIMD_CALL(levels_wide);
    kernel(t, width, height, x, y, count, out);
}
} // namespace scanout::shade::texture

namespace scanout::shade::test {

std::vector<float> levels(bool narrow, const Primitive& triangle, float width, float height,
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
