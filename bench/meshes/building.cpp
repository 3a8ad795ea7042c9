#include "bench/meshes/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace scanout::bench {
namespace {

struct Box {
    DVec3 low, high;
};

// Six sides of two triangles; seen from outside, or, of a room, from inside.
void add_box(geom::PolygonMesh& mesh, const Box& box, bool room = false) {
    const std::size_t first = mesh.positions.size();
    for (int i = 0; i < 8; ++i)
        mesh.positions.emplace_back((i & 1) != 0 ? box.high.x : box.low.x,
                                    (i & 2) != 0 ? box.high.y : box.low.y,
                                    (i & 4) != 0 ? box.high.z : box.low.z);
    constexpr std::array<std::array<std::size_t, 4>, 6> kSides = {
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& s : kSides) {
        const std::size_t a = first + s[0], b = first + s[1], c = first + s[2], d = first + s[3];
        add_triangle(mesh, a, room ? c : b, room ? b : c);
        add_triangle(mesh, a, room ? d : c, room ? c : d);
    }
}

// A turned column with its base and capital, from y = 0 up to a height of 1, times `height`.
void add_column(geom::PolygonMesh& mesh, const DVec3& foot, double radius, double height,
                const GridSize& size) {
    const auto rows = static_cast<double>(size.v);
    add_grid(mesh, size, [&](double u, double row) {
        // The first and the last row close the ends, which are flat.
        const double v = std::clamp((row * rows - 1) / (rows - 2), 0.0, 1.0);
        const double angle = 2 * std::numbers::pi * u;
        const double end = std::min(v, 1 - v); // from the nearer end
        const double swell = end < 0.1 ? 0.35 * (1 - end / 0.1) : 0.03 * std::sin(v * 40);
        const double flute = end < 0.1 ? 1 : 1 - 0.06 * std::abs(std::sin(angle * 6));
        const double r = row == 0 || row == 1 ? 0 : radius * (1 + swell) * flute;
        return DVec3(foot.x + r * std::cos(angle), foot.y + height * v,
                     foot.z - r * std::sin(angle));
    });
}

constexpr double kHalfLength = 14, kHalfWidth = 7, kHeight = 9;

// Outside in, as such models are stored: each layer is drawn over the one before.
void add_walls(geom::PolygonMesh& mesh) {
    add_box(mesh, {{-kHalfLength, 0, -kHalfWidth}, {kHalfLength, kHeight, kHalfWidth}}, true);
    for (int side = -1; side <= 1; side += 2) {
        // Panels and window frames on the walls.
        for (int i = -13; i <= 13; ++i)
            for (int storey = 0; storey < 2; ++storey) {
                const double y = 0.8 + 4.2 * storey, z = side * kHalfWidth;
                add_box(mesh, {{i - 0.35, y, std::min(z, z - side * 0.25)},
                               {i + 0.35, y + 2.6, std::max(z, z - side * 0.25)}});
            }
        // The gallery's floor, in slabs, and the wall of piers before the aisles.
        for (int i = -14; i < 14; ++i)
            add_box(mesh, {{i + 0.0, 4.0, std::min(side * 3.6, side * kHalfWidth)},
                           {i + 1.0, 4.4, std::max(side * 3.6, side * kHalfWidth)}});
        for (int i = -4; i <= 4; ++i)
            for (int storey = 0; storey < 2; ++storey)
                add_box(mesh, {{3.0 * i - 0.9, 4.4 * storey, side * 4.6 - 0.3},
                               {3.0 * i + 0.9, 4.0 + 4.4 * storey, side * 4.6 + 0.3}});
    }
}

// Small things, of many triangles each: what makes the number.
void add_columns(geom::PolygonMesh& mesh) {
    for (int side = -1; side <= 1; side += 2)
        for (int i = -6; i <= 6; ++i) {
            add_column(mesh, {2.0 * i, 0, side * 3.3}, 0.34, 4.0, {30, 18, true, false});
            add_column(mesh, {2.0 * i, 4.4, side * 3.3}, 0.26, 4.2, {22, 10, true, false});
        }
}

void add_furniture(geom::PolygonMesh& mesh) {
    // Balusters and rails of the gallery.
    for (int side = -1; side <= 1; side += 2) {
        for (int i = -26; i <= 26; ++i)
            add_column(mesh, {0.5 * i, 4.4, side * 3.6}, 0.07, 0.9, {8, 5, true, false});
        add_box(mesh, {{-13.5, 5.3, side * 3.6 - 0.1}, {13.5, 5.4, side * 3.6 + 0.1}});
    }
    // Beams under the roof, hangings between the columns, benches on the floor.
    for (int i = -13; i <= 13; ++i)
        add_box(mesh, {{i - 0.15, kHeight - 0.8, -kHalfWidth}, {i + 0.15, kHeight, kHalfWidth}});
    for (int side = -1; side <= 1; side += 2)
        for (int i = -6; i < 6; ++i)
            add_grid(mesh, {24, 12}, [&](double u, double v) {
                const double fold = 0.12 * std::sin(u * 24) * (1 - 0.5 * v);
                const double x = 2.0 * i + 0.45 + 1.1 * u;
                return DVec3(side > 0 ? x : 2.0 * i + 2 - (x - 2.0 * i), 1.9 + 2.0 * v,
                             side * 3.0 - fold);
            });
    for (int row = -3; row <= 3; ++row)
        for (int seat = -1; seat <= 1; seat += 2)
            add_box(mesh, {{3.1 * row + 0.9, 0, seat * 1.5 - 0.9},
                           {3.1 * row + 1.4, 0.5, seat * 1.5 + 0.9}});
}

} // namespace

geom::PolygonMesh building() {
    geom::PolygonMesh mesh;
    add_walls(mesh);
    add_furniture(mesh);
    add_columns(mesh);
    return mesh;
}

} // namespace scanout::bench
