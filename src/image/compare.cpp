#include "image/compare.h"

#include <algorithm>
#include <cstdlib>

namespace scanout::image {

static int largest_difference(const Rgba8& a, const Rgba8& b) {
    return std::max(
        {std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b), std::abs(a.a - b.a)});
}

Difference compare(const Image& a, const Image& b, int max_difference_allowed) {
    Difference result;
    result.same_size = a.width() == b.width() && a.height() == b.height();
    if (!result.same_size) return result;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const int difference = largest_difference(a.pixels()[i], b.pixels()[i]);
        result.max_difference = std::max(result.max_difference, difference);
        result.differing_pixels += difference > 0;
        result.over_tolerance += difference > max_difference_allowed;
    }
    return result;
}

static Rgba8 difference_pixel(const Rgba8& a, const Rgba8& b, int gain) {
    const int alpha = std::abs(a.a - b.a);
    const auto channel = [&](std::uint8_t x, std::uint8_t y) {
        const std::int64_t amplified = std::int64_t{std::max(std::abs(x - y), alpha)} * gain;
        return static_cast<std::uint8_t>(std::clamp<std::int64_t>(amplified, 0, 255));
    };
    return {channel(a.r, b.r), channel(a.g, b.g), channel(a.b, b.b), 255};
}

Image difference_image(const Image& a, const Image& b, int gain) {
    constexpr Rgba8 kOnlyInOne{255, 255, 255, 255};
    Image out(std::max(a.width(), b.width()), std::max(a.height(), b.height()), kOnlyInOne);
    const int width = std::min(a.width(), b.width());
    const int height = std::min(a.height(), b.height());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            out.at(x, y) = difference_pixel(a.at(x, y), b.at(x, y), gain);
    return out;
}

} // namespace scanout::image
