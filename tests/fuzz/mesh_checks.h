// What holds for whatever a mesh reader makes of whatever bytes, and for the mesh that is built of
// it.
#pragma once

#include "base/check.h"
#include "base/warnings.h"
#include "geom/build.h"
#include "geom/polygon_mesh.h"

#include <cmath>
#include <cstdint>
#include <utility>

namespace scanout::fuzz {

inline void check_polygons(const geom::PolygonMesh& m) {
    CHECK_EQ(m.face_material.size(), m.faces());
    CHECK(m.face_smoothing.empty() || m.face_smoothing.size() == m.faces());
    CHECK(m.colours.empty() || m.colours.size() == m.positions.size());
    CHECK_EQ(m.line_material.size(), m.line_begin.size());
    CHECK_EQ(m.point_material.size(), m.point_vertices.size());
    for (std::size_t f = 0; f < m.faces(); ++f)
        CHECK_GE(m.face_end(f), m.face_begin[f] + std::size_t{3});
    for (const geom::Corner& c : m.corners) {
        CHECK(c.position >= 0 && static_cast<std::size_t>(c.position) < m.positions.size());
        CHECK(c.uv >= -1 && c.uv < static_cast<std::int64_t>(m.uvs.size()));
        CHECK(c.normal >= -1 && c.normal < static_cast<std::int64_t>(m.normals.size()));
    }
    for (const std::uint32_t v : m.line_vertices)
        CHECK_LT(v, m.positions.size());
    for (const std::uint32_t v : m.point_vertices)
        CHECK_LT(v, m.positions.size());
    CHECK(m.faces() + m.line_begin.size() + m.point_vertices.size() > 0);
}

inline void check_built(geom::PolygonMesh&& polygons) {
    Warnings warnings;
    const geom::Mesh mesh = geom::build_mesh(std::move(polygons), {}, "x", warnings).mesh;
    for (const Vec3& p : mesh.position)
        for (int i = 0; i < 3; ++i)
            CHECK(std::isfinite(p[i]) && std::abs(p[i]) <= 1);
    for (const Vec3& n : mesh.normal)
        CHECK(std::abs(dot3(n, n) - 1) < 1e-3F);
    for (const std::uint32_t i : mesh.index)
        CHECK_LT(i, mesh.position.size());
    for (const std::uint32_t i : mesh.line_index)
        CHECK_LT(i, mesh.position.size());
    for (const std::uint32_t i : mesh.point_index)
        CHECK_LT(i, mesh.position.size());
}

// A message is one line without control characters, whatever the file holds.
inline void check_lines(const Warnings& warnings) {
    for (const std::string& line : warnings.lines())
        for (const char c : line)
            CHECK(static_cast<unsigned char>(c) >= 0x20 && c != 0x7f);
}

} // namespace scanout::fuzz
