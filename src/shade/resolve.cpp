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

void resolve(const float* const* sum, const float* through, const float* back, float back_alpha,
             int count, std::uint32_t* out) {
    for (int i = 0; i < count; i += kLanes) {
        const F32 share = load<F32>(through + i);
        const F32 back_share = share * F32(back_alpha) / F32(255.0F);
        // Exact where shares are those of samples; and 255 where the background is opaque.
        const F32 alpha = F32(255.0F) - share * F32(255.0F - back_alpha);
        const F32 whole = F32(255.0F) / select(alpha > F32(0.0F), alpha, F32(1.0F));
        const auto code = [&](int c) {
            return srgb_encode((load<F32>(sum[c] + i) + F32(back[c]) * back_share) * whole);
        };
        store(packed(code(0), code(1), code(2), to_i32(alpha)), out + i); // rounded down
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
    for (auto* channel : {&red, &green, &blue, &through})
        channel->assign(count + (kRoom - kLanes), 0.0F);
}

void resolve_pixels(const PixelSums& sums, const image::Rgba8& background, int count,
                    std::uint32_t* out) {
    const float* const sum[3] = {sums.red.data(), sums.green.data(), sums.blue.data()};
    const float back[3] = {srgb_decode(background.r), srgb_decode(background.g),
                           srgb_decode(background.b)};
    SIMD_CALL(resolve)
    (sum, sums.through.data(), back, static_cast<float>(background.a), count, out);
}

} // namespace scanout::shade
#endif
