// Data URIs (RFC 2397, RFC 4648).
#include "io/gltf_uri.h"

#include "io/file_name.h"

#include <array>
#include <cstddef>

namespace scanout::io::gltf {
namespace {

constexpr std::int8_t kNone = -1;

constexpr std::array<std::int8_t, 256> make_digits() {
    std::array<std::int8_t, 256> digits{};
    for (auto& digit : digits)
        digit = kNone;
    constexpr std::string_view kAlphabet =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < kAlphabet.size(); ++i)
        digits[static_cast<std::uint8_t>(kAlphabet[i])] = static_cast<std::int8_t>(i);
    return digits;
}
constexpr std::array<std::int8_t, 256> kDigits = make_digits();

std::optional<Bytes> of_base64(std::string_view text) {
    for (int i = 0; i < 2 && text.ends_with('='); ++i)
        text.remove_suffix(1);
    if (text.size() % 4 == 1) return std::nullopt;
    Bytes bytes;
    bytes.reserve(text.size() / 4 * 3 + 2);
    std::uint32_t word = 0;
    int bits = 0;
    for (const char c : text) {
        const std::int8_t digit = kDigits[static_cast<std::uint8_t>(c)];
        if (digit == kNone) return std::nullopt;
        word = word << 6 | static_cast<std::uint32_t>(digit);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes.push_back(static_cast<std::uint8_t>(word >> bits));
    }
    return bytes;
}

} // namespace

bool is_data_uri(std::string_view uri) {
    return uri.starts_with("data:");
}

std::optional<Bytes> data_of_uri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (!is_data_uri(uri) || comma == std::string_view::npos) return std::nullopt;
    const std::string_view data = uri.substr(comma + 1);
    if (uri.substr(0, comma).ends_with(";base64")) return of_base64(data);
    const std::string text = percent_decoded(data);
    return Bytes(text.begin(), text.end());
}

bool has_scheme(std::string_view uri) {
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const char c = uri[i], lower = static_cast<char>(c | 0x20);
        if (c == ':') return i > 1; // one letter is a drive of Windows
        const bool letter = lower >= 'a' && lower <= 'z';
        if (!letter && (i == 0 || ((c < '0' || c > '9') && c != '+' && c != '-' && c != '.')))
            return false;
    }
    return false;
}

} // namespace scanout::io::gltf
