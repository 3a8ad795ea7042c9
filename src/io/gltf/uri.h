// URIs of glTF files: data in place, and names of files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::io::gltf {

using Bytes = std::vector<std::uint8_t>;

bool is_data_uri(std::string_view uri);
// The bytes of "data:...;base64,...", or of percent-encoded text; nothing where it is malformed.
std::optional<Bytes> data_of_uri(std::string_view uri);

bool has_scheme(std::string_view uri); // "https:", "file:" and the like

} // namespace scanout::io::gltf
