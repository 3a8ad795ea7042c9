// gzip (Deutsch 1996): models may be compressed, and are unpacked as they are read.
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

// Unpacks all members of a gzip file, one after the other. Stops with an error as soon as they
// exceed `max_bytes`; damaged and truncated files are errors, too (Exit::unreadable).
Result<Mapping> gunzip(std::string_view file, const std::string& path, std::uint64_t max_bytes);

} // namespace scanout::io
