#include "shade/interpolate/footprint_levels.h"

#define SIMD_FILE "shade/interpolate/footprint_levels.cpp"
#include "simd/for_each_target.h"

#include "shade/setup/footprint-inl.h"

SIMD_BEGIN(scanout::shade::texture)

// Arrays have room for whole registers.
template <class D>
SIMD_INLINE void levels_of(const Primitive& t, float width, float height, const std::int32_t* x,
                           const std::int32_t* y, int count, float* out) {
    const PrimitivePlane<2> plane(t, t.uv);
    for (int i = 0; i < count; i += static_cast<int>(Int<D>::kLanes)) {
        const auto at = plane.at(load<Int<D>>(x + i), load<Int<D>>(y + i));
        store(level_of_detail<D>({at.right[0] * width, at.right[1] * height, at.down[0] * width,
                                  at.down[1] * height}),
              out + i);
    }
}
void levels_wide(const Primitive& t, float width, float height, const std::int32_t* x,
                 const std::int32_t* y, int count, float* out) {
    levels_of<F32::Tag>(t, width, height, x, y, count, out);
}
void levels_narrow(const Primitive& t, float width, float height, const std::int32_t* x,
                   const std::int32_t* y, int count, float* out) {
    levels_of<F32x8::Tag>(t, width, height, x, y, count, out);
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade::texture {
SIMD_REGISTER(levels_wide);
SIMD_REGISTER(levels_narrow);

static void run(bool narrow, const Primitive& t, float width, float height, const std::int32_t* x,
                const std::int32_t* y, int count, float* out) {
    const auto kernel = narrow ? SIMD_KERNEL(levels_narrow) : SIMD_KERNEL(levels_wide);
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
