#include "bench/meshes/shapes.h"

namespace scanout::bench {
namespace {

// Poles come out of sums that differ in their last bits.
bool apart(const DVec3& a, const DVec3& b) {
    const DVec3 d = a - b;
    return dot3(d, d) > 1e-20;
}

} // namespace

void add_triangle(geom::PolygonMesh& mesh, std::size_t a, std::size_t b, std::size_t c) {
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    mesh.face_material.push_back(0);
    for (const std::size_t vertex : {a, b, c})
        mesh.corners.push_back({static_cast<std::int32_t>(vertex), -1, -1});
}

void add_grid(geom::PolygonMesh& mesh, const GridSize& size,
              const std::function<DVec3(double u, double v)>& place) {
    const std::size_t first = mesh.positions.size();
    const std::size_t columns = size.u + (size.closed_u ? 0 : 1),
                      rows = size.v + (size.closed_v ? 0 : 1);
    for (std::size_t j = 0; j < rows; ++j)
        for (std::size_t i = 0; i < columns; ++i)
            mesh.positions.push_back(place(static_cast<double>(i) / static_cast<double>(size.u),
                                           static_cast<double>(j) / static_cast<double>(size.v)));
    const auto at = [&](std::size_t i, std::size_t j) {
        return first + j % rows * columns + i % columns;
    };
    const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
        const DVec3 &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
        if (apart(p, q) && apart(q, r) && apart(r, p)) add_triangle(mesh, a, b, c);
    };
    for (std::size_t j = 0; j < size.v; ++j)
        for (std::size_t i = 0; i < size.u; ++i) {
            add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
}

} // namespace scanout::bench
