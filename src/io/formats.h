// Which model format a file has, told by its content first and by its name where that says nothing.
#pragma once

#include "base/result.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace scanout::io {

enum class ModelFormat : std::uint8_t { obj, stl, ply, off, gltf };

// One line for `scanout list formats`.
struct Format {
    ModelFormat format;
    std::string_view name;      // of --format
    std::string_view extension; // in lower case, with its dot
    std::string_view description;
};
std::span<const Format> formats();

// The format of --model-format's name; an error (Exit::usage) lists those that are read.
Result<ModelFormat> format_named(std::string_view name);

// What the file holds. `head`: its first bytes, 64 KB where it has as many (more are not looked
// at); `size`: of the whole. An error (Exit::unreadable) says what the file is instead, as far as
// that can be told.
Result<ModelFormat> tell_format(std::string_view head, std::uint64_t size, const std::string& path);

// The path's last extension in lower case, ".gz" not counted; "" when it has none.
std::string extension_of(const std::string& path);

} // namespace scanout::io
