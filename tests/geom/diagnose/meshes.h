// Meshes with hazards, for the tests of the diagnosis and of mending.
#pragma once

#include "geom/diagnose/diagnose.h"
#include "geom/meshes.h"

#include <algorithm>
#include <cmath>

namespace scanout::geom::testing {

inline Diagnosis diagnosed(const PolygonMesh& mesh) {
    return diagnose(jobs(), mesh, {});
}

inline void append(PolygonMesh& mesh, const PolygonMesh& more) {
    const auto positions = static_cast<std::int32_t>(mesh.positions.size());
    const auto corners = static_cast<std::uint32_t>(mesh.corners.size());
    mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
    for (Corner corner : more.corners) {
        corner.position += positions;
        mesh.corners.push_back(corner);
    }
    for (const std::uint32_t begin : more.face_begin)
        mesh.face_begin.push_back(begin + corners);
    mesh.face_material.insert(mesh.face_material.end(), more.face_material.begin(),
                              more.face_material.end());
    mesh.face_smoothing.insert(mesh.face_smoothing.end(), more.face_smoothing.begin(),
                               more.face_smoothing.end());
}

inline PolygonMesh turned(PolygonMesh mesh) {
    for (std::size_t f = 0; f < mesh.faces(); ++f)
        std::reverse(mesh.corners.begin() + mesh.face_begin[f],
                     mesh.corners.begin() + static_cast<std::ptrdiff_t>(mesh.face_end(f)));
    return mesh;
}

// `n` quads in a ring that makes half a turn; all but the last pair are wound alike.
inline PolygonMesh moebius_strip(int n) {
    PolygonMesh mesh;
    for (int i = 0; i < n; ++i) {
        const double turn = 2 * M_PI * i / n;
        for (const double side : {-0.3, 0.3}) {
            const double r = 1 + side * std::cos(turn / 2);
            mesh.positions.push_back(
                {r * std::cos(turn), r * std::sin(turn), side * std::sin(turn / 2)});
        }
    }
    for (int i = 0; i < n; ++i) {
        const bool last = i + 1 == n;
        const int a = 2 * i, b = 2 * i + 1, c = last ? 0 : 2 * i + 3, d = last ? 1 : 2 * i + 2;
        add_face(mesh, {a, b, c, d});
    }
    return mesh;
}

// A quad of 1 x 1 in a plane that leans, beside it `parts` quads along the same edge, so wide;
// coordinates of so many decimals.
inline PolygonMesh t_junction_grid(int decimals, int parts = 7, double width = 0.4) {
    const double unit = std::pow(10, decimals);
    const auto rounded = [&](double u, double v) {
        const DVec3 p(0.9 * u + 0.1 * v, 0.3 * u + 0.8 * v, 0.2 * u - 0.5 * v);
        return DVec3(std::round(p.x * unit), std::round(p.y * unit), std::round(p.z * unit)) / unit;
    };
    PolygonMesh mesh;
    mesh.positions = {rounded(-1, 0), rounded(-1, 1)};
    for (int i = 0; i <= parts; ++i)
        for (const double u : {0.0, width})
            mesh.positions.push_back(rounded(u, static_cast<double>(i) / parts));
    add_face(mesh, {0, 2, 2 + 2 * parts, 1});
    for (int i = 0; i < parts; ++i)
        add_face(mesh, {2 + 2 * i, 3 + 2 * i, 5 + 2 * i, 4 + 2 * i});
    return mesh;
}

} // namespace scanout::geom::testing
