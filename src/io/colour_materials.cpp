#include "io/colour_materials.h"

#include "math/srgb.h"

namespace scanout::io {

std::int32_t ColourMaterials::number(std::uint8_t red, std::uint8_t green, std::uint8_t blue) {
    constexpr std::uint32_t kUpperBits = 0xf8f8f8, kMiddle = 0x040404;
    std::uint32_t colour = std::uint32_t{red} << 16 | std::uint32_t{green} << 8 | blue;
    const auto known = numbers_.find(colour);
    if (known != numbers_.end()) return known->second;
    if (colours_.size() >= kMaxColours) colour = (colour & kUpperBits) | kMiddle;
    const auto [at, is_new] =
        numbers_.try_emplace(colour, static_cast<std::int32_t>(colours_.size()));
    if (is_new) colours_.push_back(colour);
    return at->second;
}

std::vector<scene::Material> ColourMaterials::materials() const {
    std::vector<scene::Material> materials(colours_.size());
    for (std::size_t i = 0; i < colours_.size(); ++i) {
        const auto linear = [&](int shift) {
            return srgb_decode(static_cast<std::uint8_t>(colours_[i] >> shift & 0xff));
        };
        materials[i] = scene::unnamed_material(Vec3(linear(16), linear(8), linear(0)));
    }
    return materials;
}

} // namespace scanout::io
