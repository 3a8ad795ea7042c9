#include "geom/edge_lines.h"

#include "base/check.h"
#include "geom/mesh_places.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <tuple>
#include <vector>

namespace scanout::geom {
namespace {

// A triangle's side, from place to place, the lower first.
struct Side {
    std::uint32_t low, high, triangle;
    bool reversed; // the triangle goes from the higher to the lower
};

std::vector<Side> sides_of(const Mesh& mesh, const std::vector<std::uint32_t>& place) {
    std::vector<Side> sides;
    sides.reserve(mesh.index.size());
    for (std::size_t t = 0; t < mesh.triangles(); ++t)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = place[mesh.index[t * 3 + k]],
                                to = place[mesh.index[t * 3 + (k + 1) % 3]];
            if (from != to)
                sides.push_back({std::min(from, to), std::max(from, to),
                                 static_cast<std::uint32_t>(t), to < from});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
    });
    return sides;
}

DVec3 normal_of(const Mesh& mesh, std::uint32_t triangle) {
    const std::uint32_t* index = mesh.index.data() + std::size_t{triangle} * 3;
    const DVec3 a(mesh.position[index[0]]), b(mesh.position[index[1]]), c(mesh.position[index[2]]);
    return cross3(b - a, c - a);
}

// Takes the sides of one edge that are borders of their faces: two triangles of a face that share
// an edge have it inside. Sides are in the order of triangles, so those of a face stand together.
void find_borders(const Mesh& mesh, std::span<const Side> sides, std::vector<Side>& borders) {
    borders.clear();
    for (std::size_t i = 0; i < sides.size();) {
        const std::size_t begin = i;
        while (i < sides.size() && mesh.face[sides[i].triangle] == mesh.face[sides[begin].triangle])
            ++i;
        if ((i - begin) % 2 == 1) borders.push_back(sides[begin]);
    }
}

bool is_feature(const Mesh& mesh, const std::vector<Side>& borders, double cosine) {
    if (borders.size() != 2) return true;
    DVec3 a = normal_of(mesh, borders[0].triangle);
    const DVec3 b = normal_of(mesh, borders[1].triangle);
    if (borders[0].reversed == borders[1].reversed) a = -a; // wound against each other
    return dot3(a, b) < cosine * std::sqrt(dot3(a, a) * dot3(b, b));
}

std::uint32_t first_triangle(const Mesh& mesh, std::uint32_t triangle) {
    while (triangle > 0 && mesh.face[triangle - 1] == mesh.face[triangle])
        --triangle;
    return triangle;
}

} // namespace

void add_edge_lines(const Mesh& mesh, std::optional<double> feature_cosine, Mesh& lines) {
    CHECK(lines.line_faces.list.empty());
    constexpr std::uint32_t kNone = 0xffffffff;
    const MeshPlaces places = find_places(mesh);
    const std::vector<Side> sides = sides_of(mesh, places.of_vertex);
    std::vector<std::uint32_t> drawn(places.vertex.size(), kNone); // vertices of `lines` by place
    const auto vertex = [&](std::uint32_t at) {
        if (drawn[at] == kNone) {
            drawn[at] = static_cast<std::uint32_t>(lines.position.size());
            lines.position.push_back(mesh.position[places.vertex[at]]);
        }
        return drawn[at];
    };
    LineFaces& faces = lines.line_faces;
    faces.begin.push_back(0);
    for (std::size_t line = 0; line < lines.lines(); ++line) // those before lie on no face
        faces.list.push_back(0);
    faces.begin.push_back(0);
    std::vector<Side> borders;
    for (std::size_t i = 0; i < sides.size();) {
        const std::size_t begin = i;
        while (i < sides.size() && sides[i].low == sides[begin].low &&
               sides[i].high == sides[begin].high)
            ++i;
        find_borders(mesh, std::span(sides).subspan(begin, i - begin), borders);
        if (borders.empty() || (feature_cosine && !is_feature(mesh, borders, *feature_cosine)))
            continue;
        lines.line_index.push_back(vertex(sides[begin].low));
        lines.line_index.push_back(vertex(sides[begin].high));
        faces.list.push_back(static_cast<std::uint32_t>(faces.begin.size() - 1));
        for (const Side& side : borders)
            faces.triangle.push_back(first_triangle(mesh, side.triangle));
        faces.begin.push_back(static_cast<std::uint32_t>(faces.triangle.size()));
    }
}

} // namespace scanout::geom
