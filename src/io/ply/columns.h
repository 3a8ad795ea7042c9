// Which property of a PLY element means what, by the names that programs give them.
#pragma once

#include "io/ply/header.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace scanout::io {

using PlyColumn = std::optional<std::size_t>; // a property's index

inline constexpr std::string_view kPlyVertexLists[] = {"vertex_indices", "vertex_index"};
inline constexpr std::string_view kPlyTexcoord[] = {"texcoord"}, kPlyTexnumber[] = {"texnumber"};
inline constexpr std::string_view kPlyVertex1[] = {"vertex1"}, kPlyVertex2[] = {"vertex2"};

// Where an element's rows keep a colour.
struct PlyColours {
    std::array<std::size_t, 3> property{};
    std::array<double, 3> scale{}; // takes a stored value to [0, 1]

    static std::optional<PlyColours> find(const PlyElement& element);
};

// Where a vertex keeps what.
struct PlyVertexColumns {
    std::array<std::size_t, 3> position{};
    std::optional<std::array<std::size_t, 3>> normal, splat_colour;
    std::optional<std::array<std::size_t, 2>> uv;
    std::optional<PlyColours> colour;
};
// Nothing without x, y and z.
std::optional<PlyVertexColumns> ply_vertex_columns(const PlyElement& element);

} // namespace scanout::io
