#include "io/vertex_colours.h"

#include "math/srgb.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

namespace scanout::io {
namespace {

template <class Function>
void each_channel(std::vector<Vec3>& colours, Function&& function) {
    for (Vec3& colour : colours)
        for (int channel = 0; channel < 3; ++channel)
            function(colour[channel]);
}

bool are_bytes(std::vector<Vec3>& colours) {
    float greatest = 0;
    bool whole = true;
    each_channel(colours, [&](float value) {
        greatest = std::max(greatest, value);
        whole = whole && value == std::floor(value);
    });
    return whole && greatest > 1 && greatest <= 255;
}

} // namespace

void decode_vertex_colours(std::vector<Vec3>& colours, const std::string& path,
                           Warnings& warnings) {
    // Near black a value's light is a thirteenth of it. NaN is black, too.
    constexpr auto kDarkestCode = static_cast<float>(16 * kDarkest);
    each_channel(colours, [](float& value) { value = value > kDarkestCode ? value : 0; });
    const bool bytes = are_bytes(colours);
    if (bytes)
        warnings.add("vertex colours",
                     fmt::format("{}: the vertices' colours are whole numbers up to 255 and are "
                                 "read as bytes",
                                 path));
    each_channel(colours, [&](float& value) {
        const float encoded = bytes ? static_cast<float>(value / 255.0) : std::min(value, 1.0F);
        const auto code = static_cast<std::uint8_t>(encoded * 255 + 0.5F);
        value = encoded == static_cast<float>(code / 255.0)
                    ? srgb_decode(code) // most are, and rounded to float already
                    : static_cast<float>(linear_light_of_srgb(encoded));
    });
}

} // namespace scanout::io
