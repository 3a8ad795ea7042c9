// Colours in binary STL files. The format has none, but two programs store them in the two bytes
// behind each facet: Magics (Materialise), where the header says "COLOR=", and VisCAM.
#pragma once

#include "io/colour_materials.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace scanout::io {

class StlColours {
public:
    explicit StlColours(std::string_view header); // the file's first 80 bytes

    // The number of the facet's colour in materials(), -1: none. Of Magics' attributes 0 would be
    // black; files whose facets have no colours are full of it, so it means the object's colour.
    std::int32_t number(std::uint16_t attribute);
    const ColourMaterials& materials() const { return colours_; }

private:
    std::optional<std::array<std::uint8_t, 3>> object_; // Magics: of facets without their own
    ColourMaterials colours_;
};

} // namespace scanout::io
