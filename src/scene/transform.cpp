#include "scene/transform.h"

#include "math/rotation.h"
#include "math/transcendental.h"
#include "scene/largest_entry.h"

#include <algorithm>
#include <cmath>

namespace scanout::scene {
namespace {

constexpr double kSquare = 1e-9; // cosines of angles that count as right ones

// Of a symmetric matrix: turns in the plane of two axes until nothing is left beside the diagonal
// (Jacobi's method). Returns the axes; the diagonal then has the values.
DMat3 eigenvectors(DMat3& m) {
    constexpr int kSweeps = 32;
    DMat3 axes(1);
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                if (m[q][p] == 0) continue;
                const double half = (m[q][q] - m[p][p]) / (2 * m[q][p]);
                const double t =
                    (half < 0 ? -1 : 1) / (std::abs(half) + scanout::sqrt(half * half + 1));
                const double c = 1 / scanout::sqrt(t * t + 1), s = t * c;
                DMat3 turn(1);
                turn[p][p] = turn[q][q] = c;
                turn[q][p] = s;
                turn[p][q] = -s;
                m = transpose(turn) * m * turn;
                m[q][p] = m[p][q] = 0;
                axes = axes * turn;
            }
    return axes;
}

} // namespace

DMat3 scaling(const DVec3& factors) {
    return {DVec3(factors.x, 0, 0), DVec3(0, factors.y, 0), DVec3(0, 0, factors.z)};
}

DMat3 rotation_xyz(const DVec3& degrees) {
    return rotation_z(degrees.z) * rotation_y(degrees.y) * rotation_x(degrees.x);
}

DMat3 shear(int axis, double first, double second) {
    DMat3 m(1);
    m[axis == 0 ? 1 : 0][axis] = first;
    m[axis == 2 ? 1 : 2][axis] = second;
    return m;
}

bool is_invertible(const DMat3& m) {
    const double size = largest_entry(m);
    if (!(size > 0) || !std::isfinite(size)) return false;
    const DMat3 unit = m / size;
    DMat3 columns = unit;
    for (int c = 0; c < 3; ++c) {
        const double length = scanout::length(unit[c]);
        if (!(length > 0)) return false;
        columns[c] = unit[c] / length;
    }
    return std::abs(determinant(columns)) > 1e-12;
}

Stretch stretch_of(const DMat3& m) {
    Stretch s{length(m[0]), length(m[0])};
    for (int c = 1; c < 3; ++c) {
        s.least = std::min(s.least, length(m[c]));
        s.most = std::max(s.most, length(m[c]));
    }
    double widest = 0, beside[3] = {};
    for (int c = 0; c < 3; ++c) {
        const int d = (c + 1) % 3;
        const double cosine = std::abs(dot3(m[c], m[d]));
        widest = std::max(widest, cosine / std::max(length(m[c]) * length(m[d]), 0x1p-1000));
        beside[c] += cosine;
        beside[d] += cosine;
    }
    if (!(widest > kSquare)) return s;
    // By Gershgorin's circles, of the products of columns.
    double square = 0;
    for (int c = 0; c < 3; ++c)
        square = std::max(square, dot3(m[c], m[c]) + beside[c]);
    s.most = scanout::sqrt(square);
    s.least = std::min(s.least, std::abs(determinant(m)) / square);
    return s;
}

Decomposition polar_decomposition(const DMat3& m) {
    Decomposition d;
    const double size = largest_entry(m);
    const DMat3 unit = m / size;
    const double of_unit = determinant(unit); // that of m itself may vanish, with its sign
    d.determinant = of_unit * size * size * size;
    DMat3 squares = transpose(unit) * unit;
    d.axes = eigenvectors(squares);
    if (determinant(d.axes) < 0) d.axes[2] = -d.axes[2];
    const double sign = of_unit < 0 ? -1 : 1;
    for (int i = 0; i < 3; ++i)
        d.factors[i] = sign * length(unit * d.axes[i]); // of the small ones more digits are right
    d.rotation = unit * d.axes * scaling(DVec3(1) / d.factors) * transpose(d.axes);
    d.factors *= size;
    const DMat3& r = d.rotation;
    const DVec3 twice(r[1][2] - r[2][1], r[2][0] - r[0][2], r[0][1] - r[1][0]);
    const double trace = r[0][0] + r[1][1] + r[2][2];
    d.turn_degrees = degrees(scanout::atan2(length(twice), trace - 1));
    // Near half a turn the differences vanish; the sums then have the axis.
    int most = 0;
    for (int i = 1; i < 3; ++i)
        if (r[i][i] > r[most][most]) most = i;
    DVec3 by_sums(r[0][most] + r[most][0], r[1][most] + r[most][1], r[2][most] + r[most][2]);
    by_sums[most] += 1 - trace;
    if (dot3(by_sums, twice) < 0) by_sums = -by_sums;
    const bool is_turned = d.turn_degrees > 1e-9;
    d.turn_axis = normalized(!is_turned ? DVec3(0, 0, 1) : trace < 0 ? by_sums : twice);
    return d;
}

} // namespace scanout::scene
