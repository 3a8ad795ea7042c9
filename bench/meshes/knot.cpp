#include "bench/meshes/shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scanout::bench {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kAround = 3, kThrough = 2; // of the torus
constexpr double kTube = 0.165;          // radius; of the torus: 1 and 0.42

DVec3 on_curve(double t) {
    const double a = kTurn * kThrough * t, b = kTurn * kAround * t;
    const double ring = 1 + 0.42 * std::cos(b);
    return {ring * std::cos(a), ring * std::sin(a), 0.42 * std::sin(b)};
}

DVec3 unit(const DVec3& v) {
    return v / std::sqrt(dot3(v, v));
}

// Scales and folds, of three sizes: their wavelengths are whole shares of the surface, so that it
// closes. The finest are as high as asked.
double displacement(double along, double around, double finest) {
    const double a = kTurn * along, b = kTurn * around;
    return 0.10 * std::sin(9 * a) + 0.035 * std::sin(61 * a + 3 * b) * std::sin(5 * b) +
           0.012 * std::sin(241 * a - 2 * b) * std::sin(19 * b + 23 * a) +
           finest * std::sin(701 * a + 7 * b) * std::sin(97 * b);
}

} // namespace

geom::PolygonMesh knot(std::size_t triangles, double finest_fold) {
    // The tube is about eleven times as long as around: squares are square.
    const double squares = static_cast<double>(triangles) / 2;
    GridSize size;
    size.u = std::max<std::size_t>(3, static_cast<std::size_t>(std::sqrt(squares / 11)));
    size.v = std::max<std::size_t>(3, static_cast<std::size_t>(squares) / size.u);
    size.closed_u = size.closed_v = true;
    geom::PolygonMesh mesh;
    mesh.positions.reserve(size.u * size.v);
    mesh.corners.reserve(size.u * size.v * 6);
    add_grid(mesh, size, [finest_fold](double u, double v) {
        const DVec3 at = on_curve(v);
        const DVec3 ahead = unit(on_curve(v + 1e-4) - on_curve(v - 1e-4));
        const DVec3 side = unit(cross3(ahead, DVec3(at.x, at.y, 0.2)));
        const DVec3 up = cross3(side, ahead);
        const double angle = kTurn * u;
        const double radius = kTube * (1 + displacement(v, u, finest_fold));
        return at + (up * std::cos(angle) + side * std::sin(angle)) * radius;
    });
    return mesh;
}

geom::PolygonMesh crate(std::size_t triangles_inside) {
    geom::PolygonMesh mesh = knot(triangles_inside);
    const std::size_t first = mesh.positions.size();
    const DVec3 half(1.7, 1.7, 0.7); // beyond the tube's reach
    for (int corner = 0; corner < 8; ++corner) {
        const auto side = [&](int axis) { return (corner >> axis & 1) != 0 ? 1.0 : -1.0; };
        mesh.positions.push_back(half * DVec3(side(0), side(1), side(2)));
    }
    const auto face = [&](std::size_t a, std::size_t b, std::size_t c, std::size_t d) {
        add_triangle(mesh, first + a, first + b, first + c);
        add_triangle(mesh, first + a, first + c, first + d);
    };
    face(0, 2, 3, 1);
    face(4, 5, 7, 6);
    face(0, 1, 5, 4);
    face(2, 6, 7, 3);
    face(0, 4, 6, 2);
    face(1, 3, 7, 5);
    return mesh;
}

} // namespace scanout::bench
