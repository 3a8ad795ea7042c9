// Text of unknown origin: shows it safely in messages, compares it without case, and recognises
// files whose contents do not match their name.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace scanout::io {

// `text` for a message: keeps valid UTF-8, replaces control characters and other bytes by '?' (a
// file must not control the user's terminal), and cuts the text after `limit` bytes.
std::string shown(std::string_view text, std::size_t limit = 60);

std::string lower_case(std::string_view text); // ASCII letters only

// The reason, by its first bytes, why this file cannot be a text model: "is compressed with gzip:
// unpack it first (gunzip)". Nothing when it may be one.
std::optional<std::string> not_a_text_model(std::string_view file);

} // namespace scanout::io
