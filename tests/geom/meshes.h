// Small meshes that the tests of geom share.
#pragma once

#include "base/jobs.h"
#include "geom/polygon_mesh.h"

#include <cstdint>
#include <initializer_list>
#include <random>
#include <vector>

namespace scanout::geom::testing {

// Several threads: what the tests of single functions run on.
inline Jobs& jobs() {
    static Jobs jobs(3);
    return jobs;
}

inline void add_face(PolygonMesh& mesh, const std::vector<std::int32_t>& positions,
                     std::uint32_t smoothing = kSmoothingUnset, std::int32_t material = -1) {
    mesh.face_begin.push_back(static_cast<std::uint32_t>(mesh.corners.size()));
    for (const std::int32_t position : positions) {
        Corner corner;
        corner.position = position;
        mesh.corners.push_back(corner);
    }
    mesh.face_material.push_back(material);
    mesh.face_smoothing.push_back(smoothing);
}

// The cube [-half, half]^3 about `centre`, six quads, outward.
inline PolygonMesh cube(double half = 1, const DVec3& centre = DVec3(0),
                        std::uint32_t smoothing = kSmoothingUnset) {
    PolygonMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back(centre +
                                 half * DVec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    for (const auto& face : std::initializer_list<std::vector<std::int32_t>>{
             {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}})
        add_face(mesh, face, smoothing);
    return mesh;
}

// Triangles, quadrilaterals and pentagons between random positions, as no modeller makes them:
// every vertex is non-manifold, many faces are degenerate.
inline PolygonMesh soup(std::uint32_t seed, int positions, int faces, bool with_groups) {
    std::mt19937 random(seed);
    const auto below = [&](int n) {
        return static_cast<std::int32_t>(random() % static_cast<unsigned>(n));
    };
    PolygonMesh mesh;
    for (int i = 0; i < positions; ++i)
        mesh.positions.push_back(DVec3{below(2001) - 1000, below(2001) - 1000, below(2001) - 1000} /
                                 1000.0);
    for (int f = 0; f < faces; ++f) {
        std::vector<std::int32_t> corners(static_cast<std::size_t>(3 + below(3)));
        for (std::int32_t& c : corners)
            c = below(positions);
        const int group = below(4);
        add_face(mesh, corners,
                 !with_groups || group == 3 ? kSmoothingUnset : static_cast<std::uint32_t>(group),
                 below(3));
    }
    return mesh;
}

// The same faces in the order `order[0], order[1] ...`.
inline PolygonMesh reordered(const PolygonMesh& mesh, const std::vector<std::size_t>& order) {
    PolygonMesh out = mesh;
    out.corners.clear();
    out.face_begin.clear();
    for (std::size_t i = 0; i < order.size(); ++i) {
        out.face_begin.push_back(static_cast<std::uint32_t>(out.corners.size()));
        for (std::size_t c = mesh.face_begin[order[i]]; c < mesh.face_end(order[i]); ++c)
            out.corners.push_back(mesh.corners[c]);
        out.face_material[i] = mesh.face_material[order[i]];
        out.face_smoothing[i] = mesh.face_smoothing[order[i]];
    }
    return out;
}

} // namespace scanout::geom::testing
