#include "app/report/info_report.h"

#include "app/report/json_text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace scanout::app {
namespace {

using Json = nlohmann::ordered_json;

const io::Format& row_of(io::ModelFormat format) {
    return *std::find_if(io::formats().begin(), io::formats().end(),
                         [&](const io::Format& row) { return row.format == format; });
}

std::string upper(std::string_view word) {
    std::string letters(word);
    for (char& letter : letters)
        letter = static_cast<char>(letter >= 'a' && letter <= 'z' ? letter - 'a' + 'A' : letter);
    return letters;
}

std::string count_of(std::size_t count, std::string_view one, std::string_view many = "") {
    if (count == 1) return fmt::format("1 {}", one);
    return many.empty() ? fmt::format("{} {}s", count, one) : fmt::format("{} {}", count, many);
}

// Six digits of the model's size, however far from the origin it stands.
int digits_of_places(const ModelInfo& info) {
    double size = 0, farthest = 0;
    for (int axis = 0; axis < 3; ++axis) {
        size = std::max(size, info.box_max[axis] - info.box_min[axis]);
        farthest = std::max({farthest, std::abs(info.box_min[axis]), std::abs(info.box_max[axis])});
    }
    if (!(size > 0) || !(farthest > size)) return 6;
    return std::min(6 + static_cast<int>(std::ceil(std::log10(farthest / size))), 17);
}

std::string numbers(const DVec3& v, std::string_view between, int digits = 6) {
    return fmt::format("{:.{}g}{}{:.{}g}{}{:.{}g}", v.x, digits, between, v.y, digits, between, v.z,
                       digits);
}

std::string line(std::string_view title, std::string_view text) {
    return fmt::format("  {:<10} {}", title, text);
}

std::string elements(const scene::ModelCounts& c) {
    std::vector<std::string> parts = {count_of(c.vertices, "vertex", "vertices"),
                                      count_of(c.faces, "face"), count_of(c.triangles, "triangle")};
    if (c.lines > 0) parts.push_back(count_of(c.lines, "line"));
    if (c.points > 0) parts.push_back(count_of(c.points, "point"));
    if (c.skipped > 0) parts.push_back(fmt::format("{} skipped", c.skipped));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string attributes(const ModelInfo& info) {
    std::vector<std::string> parts;
    if (info.normals) parts.emplace_back("normals");
    if (info.uvs) parts.emplace_back("texture coordinates");
    if (info.colours) parts.emplace_back("colours of vertices");
    if (info.face_colours) parts.emplace_back("colours of faces");
    if (parts.empty()) parts.emplace_back("positions only");
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string winding(const ModelInfo& info) {
    if (info.mixed_winding > 0)
        return fmt::format("wound inconsistently along {}", count_of(info.mixed_winding, "edge"));
    if (info.inside_out == 0) return "wound outwards";
    return info.inside_out == info.counts.triangles ? "wound inwards" : "in part inside out";
}

std::string quantity(std::string_view what, const std::optional<double>& value) {
    if (!value) return fmt::format("{} beyond the range of numbers", what);
    return fmt::format("{} {:.6g}", what, *value);
}

std::string surface(const ModelInfo& info) {
    if (!info.has_area) return "no area";
    std::vector<std::string> parts;
    if (info.closed)
        parts.push_back("closed, " + winding(info));
    else
        parts.push_back(fmt::format("open: {}", count_of(info.open_edges, "open edge")));
    parts.push_back(info.non_manifold_edges > 0
                        ? count_of(info.non_manifold_edges, "non-manifold edge")
                        : "manifold");
    parts.push_back(quantity("area", info.area));
    if (info.encloses) parts.push_back(quantity("volume", info.volume));
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string map_text(const MapInfo& map) {
    const std::string_view state = !map.drawn          ? "not drawn"
                                   : map.missing       ? "missing"
                                   : map.found.empty() ? "not needed"
                                                       : "";
    return fmt::format(
        "{}: {} {} ({})", map.material.empty() ? "(no name)" : map.material, map.kind, map.path,
        state.empty() ? fmt::format("{} x {}", map.width, map.height) : std::string(state));
}

// What a matrix does: it stretches along three axes at right angles, then turns.
std::vector<std::string> transform_lines(const scene::Placement& t) {
    const DMat3 rows = transpose(t.linear);
    std::vector<std::string> lines = {
        line("transform",
             fmt::format("{}; {}; {}; moves by {}", numbers(rows[0], " "), numbers(rows[1], " "),
                         numbers(rows[2], " "), numbers(t.offset, ",")))};
    if (!scene::is_invertible(t.linear)) {
        lines.push_back(line("", "singular: it flattens the model, and nothing undoes it"));
        return lines;
    }
    const scene::Decomposition d = scene::polar_decomposition(t.linear);
    std::string stretch = fmt::format("stretches by {}", numbers(d.factors, ", "));
    if (d.factors.x == d.factors.y && d.factors.y == d.factors.z)
        stretch = fmt::format("scales by {:.6g}", d.factors.x);
    else
        stretch += fmt::format(" along {}; {}; {}", numbers(d.axes[0], ","),
                               numbers(d.axes[1], ","), numbers(d.axes[2], ","));
    lines.push_back(line("", fmt::format("determinant {:.6g}: {}", d.determinant, stretch)));
    if (d.turn_degrees > 0)
        lines.push_back(line("", fmt::format("then turns by {:.6g} degrees about {}",
                                             d.turn_degrees, numbers(d.turn_axis, ","))));
    return lines;
}

Json transform_json(const scene::Placement& t) {
    const auto vector = [](const DVec3& v) { return Json{v.x, v.y, v.z}; };
    Json matrix = Json::array();
    for (int row = 0; row < 3; ++row)
        for (const double entry :
             {t.linear[0][row], t.linear[1][row], t.linear[2][row], t.offset[row]})
            matrix.push_back(entry);
    for (const double entry : {0.0, 0.0, 0.0, 1.0})
        matrix.push_back(entry);
    Json json = {{"matrix", matrix}, {"singular", !scene::is_invertible(t.linear)}};
    if (!scene::is_invertible(t.linear)) return json;
    const scene::Decomposition d = scene::polar_decomposition(t.linear);
    json["determinant"] = d.determinant;
    json["factors"] = vector(d.factors);
    json["axes"] = {vector(d.axes[0]), vector(d.axes[1]), vector(d.axes[2])};
    json["turn_axis"] = vector(d.turn_axis);
    json["turn_degrees"] = d.turn_degrees;
    return json;
}

} // namespace

std::vector<std::string> info_lines(const ModelInfo& info) {
    const DVec3 size = info.box_max - info.box_min;
    const int digits = digits_of_places(info);
    std::vector<std::string> lines = {
        fmt::format("{}: {}, {} is up, read in {:.0f} ms", info.path,
                    upper(row_of(info.format).name), name_of(info.up), info.load_ms),
        line("elements", elements(info.counts)), line("gives", attributes(info)),
        line("size",
             fmt::format("{}, from {} to {}", numbers(size, " x "),
                         numbers(info.box_min, ",", digits), numbers(info.box_max, ",", digits)))};
    if (info.counts.triangles > 0) lines.push_back(line("surface", surface(info)));
    if (!info.materials.empty())
        lines.push_back(line("materials", fmt::format("{}: {}", info.materials.size(),
                                                      fmt::join(info.materials, ", "))));
    for (const MapInfo& map : info.maps)
        lines.push_back(line("texture", map_text(map)));
    if (info.transform)
        for (const std::string& one : transform_lines(*info.transform))
            lines.push_back(one);
    for (const std::string& camera : info.cameras)
        lines.push_back(line("camera", camera));
    for (std::size_t i = 0; i < info.animations.size(); ++i)
        lines.push_back(line("animation", fmt::format("{} {}", i, info.animations[i])));
    return lines;
}

std::string info_json(const ModelInfo& info) {
    const auto vector = [](const DVec3& v) { return Json{v.x, v.y, v.z}; };
    Json maps = Json::array();
    for (const MapInfo& map : info.maps) {
        Json json = {{"material", map.material}, {"map", map.kind},    {"path", map.path},
                     {"line", map.line},         {"drawn", map.drawn}, {"missing", map.missing}};
        json["found"] = map.found.empty() ? Json(nullptr) : Json(map.found);
        if (!map.found.empty()) {
            json["width"] = map.width;
            json["height"] = map.height;
        }
        maps.push_back(std::move(json));
    }
    Json surface(nullptr);
    if (info.counts.triangles > 0) {
        surface = {{"closed", info.closed},
                   {"inside_out_triangles", info.inside_out},
                   {"edges_of_mixed_winding", info.mixed_winding},
                   {"manifold", info.non_manifold_edges == 0},
                   {"open_edges", info.open_edges},
                   {"non_manifold_edges", info.non_manifold_edges}};
        surface["area"] = info.area ? Json(*info.area) : Json(nullptr);
        surface["volume"] = info.volume ? Json(*info.volume) : Json(nullptr);
    }
    const scene::ModelCounts& c = info.counts;
    return json_text(
        versioned({{"model", info.path},
                   {"format", row_of(info.format).name},
                   {"up", name_of(info.up)},
                   {"vertices", c.vertices},
                   {"faces", c.faces},
                   {"triangles", c.triangles},
                   {"lines", c.lines},
                   {"points", c.points},
                   {"skipped", c.skipped},
                   {"normals", info.normals},
                   {"texture_coordinates", info.uvs},
                   {"colours", info.colours},
                   {"face_colours", info.face_colours},
                   {"box",
                    {{"min", vector(info.box_min)},
                     {"max", vector(info.box_max)},
                     {"size", vector(info.box_max - info.box_min)}}},
                   {"surface", std::move(surface)},
                   {"materials", info.materials},
                   {"textures", std::move(maps)},
                   {"transform", info.transform ? transform_json(*info.transform) : Json(nullptr)},
                   {"cameras", info.cameras},
                   {"animations", info.animations},
                   {"warnings", info.warnings},
                   {"version", SCANOUT_VERSION}}));
}

} // namespace scanout::app
