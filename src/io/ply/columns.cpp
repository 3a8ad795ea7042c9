#include "io/ply/columns.h"

#include <span>

namespace scanout::io {
namespace {

using Names = std::span<const std::string_view>;
constexpr std::string_view kX[] = {"x"}, kY[] = {"y"}, kZ[] = {"z"};
constexpr std::string_view kNx[] = {"nx"}, kNy[] = {"ny"}, kNz[] = {"nz"};
constexpr std::string_view kU[] = {"s", "u", "texture_u", "tu", "s0"};
constexpr std::string_view kV[] = {"t", "v", "texture_v", "tv", "t0"};
constexpr std::string_view kRed[] = {"red", "diffuse_red", "r"};
constexpr std::string_view kGreen[] = {"green", "diffuse_green", "g"};
constexpr std::string_view kBlue[] = {"blue", "diffuse_blue", "b"};
constexpr std::string_view kSplat[][1] = {{"f_dc_0"}, {"f_dc_1"}, {"f_dc_2"}};

// The scale that takes a colour's stored values to [0, 1]; floats are in it already.
double colour_scale(PlyType type) {
    switch (type) {
    case PlyType::float32:
    case PlyType::float64:
        return 1;
    case PlyType::int8:
    case PlyType::uint8:
        return 1 / 255.0;
    default:
        return 1 / 65535.0;
    }
}

template <std::size_t N>
std::optional<std::array<std::size_t, N>> find_all(const PlyElement& element,
                                                   const std::array<Names, N>& names) {
    std::array<std::size_t, N> columns{};
    for (std::size_t i = 0; i < N; ++i) {
        const PlyColumn property = element.find(names[i]);
        if (!property || element.properties[*property].list_length_type) return std::nullopt;
        columns[i] = *property;
    }
    return columns;
}

} // namespace

std::optional<PlyColours> PlyColours::find(const PlyElement& element) {
    const auto columns = find_all<3>(element, {kRed, kGreen, kBlue});
    if (!columns) return std::nullopt;
    PlyColours colours{*columns};
    for (std::size_t i = 0; i < 3; ++i)
        colours.scale[i] = colour_scale(element.properties[(*columns)[i]].type);
    return colours;
}

std::optional<PlyVertexColumns> ply_vertex_columns(const PlyElement& e) {
    const auto position = find_all<3>(e, {kX, kY, kZ});
    if (!position) return std::nullopt;
    PlyVertexColumns columns;
    columns.position = *position;
    columns.normal = find_all<3>(e, {kNx, kNy, kNz});
    columns.uv = find_all<2>(e, {kU, kV});
    columns.colour = PlyColours::find(e);
    if (!columns.colour) columns.splat_colour = find_all<3>(e, {kSplat[0], kSplat[1], kSplat[2]});
    return columns;
}

} // namespace scanout::io
