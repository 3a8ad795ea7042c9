// Names of files as other systems spell them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scanout::io {

// A key that all spellings of one name share: without case, characters composed (NFC), and bytes
// that are no UTF-8 read as Latin-1.
std::string folded(std::string_view name);

// %XX is the byte of that code (RFC 3986); what is none stays.
std::string percent_decoded(std::string_view name);

// The names that `name` may stand for, the likeliest first: as it is; percent-decoded; without a
// comment behind it; both.
std::vector<std::string> spellings(std::string_view name);

} // namespace scanout::io
