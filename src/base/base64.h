// Bytes as text of 64 letters and back: RFC 4648, section 4.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scanout {

std::string base64(std::span<const std::uint8_t> bytes);
std::string base64(std::string_view bytes);

// With or without "=" at the end; nothing where any other letter is found, or one is left over.
std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text);

} // namespace scanout
