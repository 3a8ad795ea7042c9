// Text of unknown origin: shown safely in messages, compared without case, and recognised when it
// is not what a file's name says.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace scanout::io {

// `text` for a message: valid UTF-8 is kept, control characters and other bytes become '?' (a file
// must not drive the user's terminal), and what is longer than `limit` bytes is cut.
std::string shown(std::string_view text, std::size_t limit = 60);

std::string lower_case(std::string_view text); // ASCII letters only

// Why this file cannot be a text model, told by its first bytes: "is compressed with gzip: unpack
// it first (gunzip)". Nothing when nothing speaks against it.
std::optional<std::string> not_a_text_model(std::string_view file);

} // namespace scanout::io
