// gzip (Deutsch 1996): a model that was compressed as it is read.
#pragma once

#include "base/mapping.h"
#include "base/result.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace scanout::io {

inline bool is_gzip(std::string_view file) {
    return file.starts_with("\x1f\x8b\x08");
}

// All members of a gzip file, unpacked one after the other. What unpacks to more than `max_bytes`
// is refused while it does, so is what is damaged or cut short (Exit::unreadable).
Result<Mapping> gunzip(std::string_view file, const std::string& path, std::uint64_t max_bytes);

} // namespace scanout::io
