#include "image/heat_map.h"

#include "base/check.h"
#include "math/transcendental.h"

#include <algorithm>
#include <cstdlib>

namespace scanout::image {
namespace {

// Magma at every eighth; between them the codes are mixed.
constexpr Rgba8 kMagma[] = {{0x00, 0x00, 0x04}, {0x1c, 0x10, 0x44}, {0x4f, 0x12, 0x7b},
                            {0x81, 0x25, 0x81}, {0xb5, 0x36, 0x7a}, {0xe5, 0x59, 0x64},
                            {0xfb, 0x87, 0x61}, {0xfe, 0xc2, 0x87}, {0xfc, 0xfd, 0xbf}};
constexpr int kSteps = std::size(kMagma) - 1;

} // namespace

int largest_difference(const Rgba8& p, const Rgba8& q) {
    return std::max({std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)});
}

const std::array<Rgba8, 256>& colours_of_differences() {
    static const std::array<Rgba8, 256> colours = [] {
        std::array<Rgba8, 256> made;
        for (std::size_t code = 0; code < made.size(); ++code)
            made[code] = heat_colour(log2(static_cast<double>(code + 1)) / 8);
        return made;
    }();
    return colours;
}

Rgba8 heat_colour(double share) {
    const double place = std::clamp(share, 0.0, 1.0) * kSteps;
    const int step = std::min(static_cast<int>(place), kSteps - 1);
    const double part = place - step;
    const Rgba8 &from = kMagma[step], &to = kMagma[step + 1];
    const auto mixed = [part](std::uint8_t a, std::uint8_t b) {
        return static_cast<std::uint8_t>(a + part * (b - a) + 0.5);
    };
    return {mixed(from.r, to.r), mixed(from.g, to.g), mixed(from.b, to.b), 255};
}

Image heat_map(int width, int height, std::span<const float> values) {
    Image map(width, height);
    CHECK(map.pixels().size() == values.size());
    std::transform(values.begin(), values.end(), map.pixels().begin(),
                   [](float value) { return heat_colour(double{value}); });
    return map;
}

Image heat_map(const Image& reference, const Image& test) {
    CHECK(reference.width() == test.width() && reference.height() == test.height());
    const std::array<Rgba8, 256>& colour = colours_of_differences();
    Image map(reference.width(), reference.height());
    std::transform(reference.pixels().begin(), reference.pixels().end(), test.pixels().begin(),
                   map.pixels().begin(), [&](const Rgba8& p, const Rgba8& q) {
                       return colour[static_cast<std::size_t>(largest_difference(p, q))];
                   });
    return map;
}

} // namespace scanout::image
