#include "shade/resolve/resolve.h"

#include "image/dither.h"
#include "shade/check_lanes.h"
#include "shade/stage.h"

#include <cstring>

#define SIMD_FILE "shade/resolve/resolve.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::shade)

// Turns sums into means.
void mean(float* const* sum, const float* transmittance, const float* back, float back_alpha,
          int count, std::int32_t* alpha_code) {
    for (int i = 0; i < count; i += kLanes) {
        const F32 background = load<F32>(transmittance + i);
        const F32 back_weight = background * F32(back_alpha) / F32(255.0F);
        // Exact where the weights are counts of samples; 255 where the background is opaque.
        const F32 alpha = F32(255.0F) - background * F32(255.0F - back_alpha);
        const F32 whole = F32(255.0F) / select(alpha > F32(0.0F), alpha, F32(1.0F));
        for (int c = 0; c < 3; ++c)
            store((load<F32>(sum[c] + i) + F32(back[c]) * back_weight) * whole, sum[c] + i);
        store(to_i32(alpha), alpha_code + i); // rounded down
    }
}

SIMD_END

#if SIMD_ONCE
namespace scanout::shade {

SIMD_REGISTER(mean);

void PixelSums::reset(std::size_t count) {
    for (auto* channel : {&red, &green, &blue, &transmittance})
        channel->assign(count + (kPaddedBlock - kBlockSize), 0.0F);
    alpha.resize(count + (kPaddedBlock - kBlockSize));
}

void resolve_pixels(PixelSums& sums, const Output& output, const image::Rgba8& background,
                    const float* offsets, int count, std::uint32_t* out) {
    const Encoding& encoding = output.sum_encoding();
    float* const sum[3] = {sums.red.data(), sums.green.data(), sums.blue.data()};
    const float back[3] = {encoding.decode(background.r), encoding.decode(background.g),
                           encoding.decode(background.b)};
    SIMD_CALL(mean, sum, sums.transmittance.data(), back, static_cast<float>(background.a), count,
              sums.alpha.data());
    for (const float* channel : sum)
        check_values({channel, static_cast<std::size_t>(count)}, "mean", "resolve");
    encoding.encode({sum[0], sum[1], sum[2], sums.alpha.data(), offsets}, count, out);
}

void resolve_area(PixelSums& sums, const Output& output, const image::Rgba8& background,
                  const image::Rect& area, image::Image& picture) {
    const auto width = static_cast<std::size_t>(area.width());
    const std::size_t count = width * static_cast<std::size_t>(area.height());
    sums.codes.resize(count + (kPaddedBlock - kBlockSize));
    if (output.dither) {
        sums.offsets.resize(sums.codes.size());
        std::size_t i = 0;
        for (int y = area.y0; y < area.y1; ++y)
            for (int x = area.x0; x < area.x1; ++x)
                sums.offsets[i++] =
                    image::dither_offset(static_cast<unsigned>(x), static_cast<unsigned>(y));
    }
    resolve_pixels(sums, output, background, output.dither ? sums.offsets.data() : nullptr,
                   static_cast<int>(count), sums.codes.data());
    for (int y = area.y0; y < area.y1; ++y)
        std::memcpy(static_cast<void*>(&picture.at(area.x0, y)),
                    sums.codes.data() + static_cast<std::size_t>(y - area.y0) * width,
                    width * sizeof(std::uint32_t));
}

bool mean_of_boxes(LinearPicture& from, int scale, const image::Rect& area, PixelSums& sums) {
    const float weight = 1.0F / static_cast<float>(scale * scale);
    std::size_t i = 0;
    bool any = false;
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x, ++i) {
            std::array<float, 4> sum{};
            for (int dy = 0; dy < scale; ++dy)
                for (int dx = 0; dx < scale; ++dx) {
                    const std::array<float, 4>& pixel = from.at(x * scale + dx, y * scale + dy);
                    for (std::size_t c = 0; c < 4; ++c)
                        sum[c] += pixel[c];
                }
            sums.red[i] = sum[0] * weight;
            sums.green[i] = sum[1] * weight;
            sums.blue[i] = sum[2] * weight;
            sums.transmittance[i] = 1 - sum[3] * weight; // exact where all is opaque
            any = any || sum[3] > 0;
        }
    return any;
}

} // namespace scanout::shade
#endif
