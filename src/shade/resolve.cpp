#include "shade/resolve.h"

#include "math/srgb.h"
#include "shade/stage.h"

#include <algorithm>

#define SIMD_FILE "shade/resolve.cpp"
#include "simd/for_each_target.h"

#include "math/srgb-inl.h"

SIMD_BEGIN(scanout::shade)

HWY_INLINE I32 packed(I32 red, I32 green, I32 blue, I32 alpha) { // image::Rgba8 in memory
    return (red | shift_left<8>(green)) | (shift_left<16>(blue) | shift_left<24>(alpha));
}

void encode(const float* red, const float* green, const float* blue, int count,
            std::uint32_t* out) {
    for (int i = 0; i < count; i += kLanes)
        store(packed(srgb_encode(load<F32>(red + i)), srgb_encode(load<F32>(green + i)),
                     srgb_encode(load<F32>(blue + i)), I32(255)),
              out + i);
}

void resolve(const float* const* sum, const std::int32_t* covered, int samples, const float* back,
             std::int32_t back_alpha, int count, std::uint32_t* out) {
    const F32 share = 1.0F / static_cast<float>(samples);
    for (int i = 0; i < count; i += kLanes) {
        const I32 shown = load<I32>(covered + i), uncovered = I32(samples) - shown;
        const F32 back_share =
            (to_f32(uncovered) * share) * F32(static_cast<float>(back_alpha)) / F32(255.0F);
        const I32 alpha = shown * I32(255) + uncovered * I32(back_alpha); // times samples
        const auto some = alpha > I32(0); // lanes beyond the last pixel hold nothing
        const F32 whole =
            F32(255.0F * static_cast<float>(samples)) / select(some, to_f32(alpha), F32(1.0F));
        const auto code = [&](int c) {
            return srgb_encode((load<F32>(sum[c] + i) + F32(back[c]) * back_share) * whole);
        };
        // alpha / samples, rounded down: exact, samples is a power of two
        const I32 mean = to_i32(to_f32(alpha) * share);
        store(packed(code(0), code(1), code(2), mean), out + i);
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade {

SIMD_REGISTER(encode);
SIMD_REGISTER(resolve);

void encode_pixels(const float* red, const float* green, const float* blue, int count,
                   std::uint32_t* out) {
    SIMD_CALL(encode)(red, green, blue, count, out);
}

void PixelSums::reset(std::size_t count) {
    for (auto* channel : {&red, &green, &blue})
        channel->assign(count + (kRoom - kLanes), 0.0F);
    covered.assign(count + (kRoom - kLanes), 0);
}

void resolve_pixels(const PixelSums& sums, int samples, const image::Rgba8& background, int count,
                    std::uint32_t* out) {
    const float* const sum[3] = {sums.red.data(), sums.green.data(), sums.blue.data()};
    const float back[3] = {srgb_decode(background.r), srgb_decode(background.g),
                           srgb_decode(background.b)};
    SIMD_CALL(resolve)(sum, sums.covered.data(), samples, back, background.a, count, out);
}

} // namespace scanout::shade
#endif
