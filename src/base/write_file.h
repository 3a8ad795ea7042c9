// Files are written whole or not at all: a temporary file beside the target, fsync, rename.
#pragma once

#include "base/result.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace scanout {

// "-" writes to standard output; a file that is there keeps its mode. The error names the path and
// what to do (Exit::unreadable); `elsewhere`: how the user has it written into another folder.
Result<void> write_file(const std::string& path, std::span<const std::uint8_t> bytes,
                        std::string_view elsewhere = "name another folder");
Result<void> write_file(const std::string& path, std::string_view text,
                        std::string_view elsewhere = "name another folder");

} // namespace scanout
