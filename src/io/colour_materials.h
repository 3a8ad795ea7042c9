// Face colours as materials: one material for each colour, so that a face's colour needs no
// vertices of its own.
#pragma once

#include "scene/material.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace scanout::io {

class ColourMaterials {
public:
    // The number of a display (sRGB) colour, from 0 on in the order of first use. Beyond
    // kMaxColours, further colours keep only the upper five bits of each channel.
    static constexpr std::size_t kMaxColours = 32768;
    std::int32_t number(std::uint8_t red, std::uint8_t green, std::uint8_t blue);

    std::size_t size() const { return colours_.size(); }
    std::vector<scene::Material> materials() const;

private:
    std::vector<std::uint32_t> colours_; // 0xRRGGBB
    std::unordered_map<std::uint32_t, std::int32_t> numbers_;
};

} // namespace scanout::io
