// The header of a PLY file (Turk 1994): the encoding of the body, and its elements with their
// properties.
#pragma once

#include "base/result.h"
#include "base/warnings.h"
#include "io/name_at_line.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::io {

enum class PlyEncoding : std::uint8_t { ascii, little_endian, big_endian };

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
std::size_t size_of(PlyType type); // bytes in a binary body

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;         // of the value, or of a list's entries
    std::optional<PlyType> list_length_type; // given: the property is a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0; // from the header: never allocate by it
    std::vector<PlyProperty> properties;

    // The index of the property of one of these names, the first name first.
    std::optional<std::size_t> find(std::span<const std::string_view> names) const;
    bool has_lists() const;
    std::size_t least_row_bytes() const; // of a binary row; exact where there are no lists
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    std::vector<NameAtLine> textures; // "comment TextureFile NAME", as MeshLab writes
    std::size_t body = 0;             // the body's first byte
    std::size_t body_line = 1;        // and its line number
};

inline bool is_ply(std::string_view file) {
    return file.starts_with("ply\n") || file.starts_with("ply\r") || file.starts_with("ply ");
}

// `path` stands in messages. Unknown but harmless statements are warnings. Errors
// (Exit::unreadable, path:line): a statement that makes the body unreadable, or no end_header.
Result<PlyHeader> read_ply_header(std::string_view file, const std::string& path,
                                  Warnings& warnings);

} // namespace scanout::io
