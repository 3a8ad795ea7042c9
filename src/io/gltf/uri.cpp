// Data URIs (RFC 2397, RFC 4648).
#include "io/gltf/uri.h"

#include "base/base64.h"
#include "io/file_name.h"

#include <cstddef>

namespace scanout::io::gltf {
bool is_data_uri(std::string_view uri) {
    return uri.starts_with("data:");
}

std::optional<Bytes> data_of_uri(std::string_view uri) {
    const std::size_t comma = uri.find(',');
    if (!is_data_uri(uri) || comma == std::string_view::npos) return std::nullopt;
    const std::string_view data = uri.substr(comma + 1);
    if (uri.substr(0, comma).ends_with(";base64")) return from_base64(data);
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
