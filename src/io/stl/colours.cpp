#include "io/stl/colours.h"

namespace scanout::io {
namespace {

constexpr std::uint16_t kFlag = 0x8000; // Magics: the object's colour; VisCAM: there is a colour

std::uint8_t five_bits(std::uint16_t attribute, int shift) {
    const int value = attribute >> shift & 31;
    return static_cast<std::uint8_t>((value * 255 + 15) / 31);
}

} // namespace

StlColours::StlColours(std::string_view header) {
    constexpr std::string_view kMark = "COLOR=";
    const std::size_t at = header.find(kMark);
    if (at == std::string_view::npos || at + kMark.size() + 3 > header.size()) return;
    object_.emplace();
    for (std::size_t i = 0; i < 3; ++i)
        (*object_)[i] = static_cast<std::uint8_t>(header[at + kMark.size() + i]);
}

std::int32_t StlColours::number(std::uint16_t attribute) {
    const bool flagged = (attribute & kFlag) != 0;
    if (object_ && (flagged || attribute == 0))
        return colours_.number((*object_)[0], (*object_)[1], (*object_)[2]);
    if (object_) // red in the lowest bits
        return colours_.number(five_bits(attribute, 0), five_bits(attribute, 5),
                               five_bits(attribute, 10));
    if (!flagged) return -1;
    return colours_.number(five_bits(attribute, 10), five_bits(attribute, 5),
                           five_bits(attribute, 0)); // VisCAM: blue in the lowest bits
}

} // namespace scanout::io
