// What stands inside HTML and SVG: text whose special characters are named, bytes as Base64.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace scanout::app {

// & < > " are named, control characters and broken UTF-8 are escaped as in message.h.
std::string as_markup(std::string_view text);

// RFC 4648, section 4, with padding.
std::string base64(std::span<const std::uint8_t> bytes);

} // namespace scanout::app
