#include "bench/meshes/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace scanout::bench {
namespace {

const DVec3& corner_place(const geom::PolygonMesh& mesh, std::size_t corner) {
    return mesh.positions[static_cast<std::size_t>(mesh.corners[corner].position)];
}

double mean_edge(const geom::PolygonMesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.corners.size(); ++i) {
        const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
        const DVec3 edge = corner_place(mesh, next) - corner_place(mesh, i);
        sum += std::sqrt(dot3(edge, edge));
    }
    return sum / static_cast<double>(mesh.corners.size());
}

// Slice, row and place in the row, in cells of a volume.
using Cell = std::array<std::int64_t, 3>;

Cell cell_at(const DVec3& place, double size) {
    const auto whole = [&](double x) { return static_cast<std::int64_t>(std::floor(x / size)); };
    return {whole(place.z), whole(place.y), whole(place.x)};
}

// 0 .. cells.size() - 1, cell by cell.
std::vector<std::size_t> walk(const std::vector<Cell>& cells) {
    std::vector<std::size_t> order(cells.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return cells[a] < cells[b]; });
    return order;
}

// Vertices and triangles in the order in which a volume's surface is made: slice by slice, row by
// row.
geom::PolygonMesh as_from_a_volume(const geom::PolygonMesh& mesh) {
    const double size = 0.6 * mean_edge(mesh); // a thousand triangles in turn use 1100 vertices
    std::vector<Cell> cells;
    for (const DVec3& place : mesh.positions)
        cells.push_back(cell_at(place, size));
    geom::PolygonMesh walked;
    std::vector<std::size_t> number(mesh.positions.size()); // of a vertex, in the walk
    for (const std::size_t vertex : walk(cells)) {
        number[vertex] = walked.positions.size();
        walked.positions.push_back(mesh.positions[vertex]);
    }
    cells.clear();
    for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
        cells.push_back(cell_at(
            (corner_place(mesh, i) + corner_place(mesh, i + 1) + corner_place(mesh, i + 2)) / 3.0,
            size));
    const auto vertex = [&](std::size_t corner) {
        return number[static_cast<std::size_t>(mesh.corners[corner].position)];
    };
    for (const std::size_t triangle : walk(cells))
        add_triangle(walked, vertex(3 * triangle), vertex(3 * triangle + 1),
                     vertex(3 * triangle + 2));
    return walked;
}

} // namespace

geom::PolygonMesh dragon(std::size_t triangles) {
    return as_from_a_volume(knot(triangles, 0.0012));
}

} // namespace scanout::bench
