// Triangles without an area, slivers and needles.
#include "geom/diagnose/families.h"
#include "geom/diagnose/shape.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scanout::geom {

double sliverness(const DVec3& a, const DVec3& b, const DVec3& c) {
    const DVec3 u = b - a, v = c - a, w = c - b;
    const double longest = std::max({dot3(u, u), dot3(v, v), dot3(w, w)});
    const DVec3 normal = cross3(u, v);
    const double area = std::sqrt(dot3(normal, normal)); // twice
    return area > 0 ? longest / area : std::numeric_limits<double>::infinity();
}

bool has_no_area(const Surface& surface, const std::array<std::uint32_t, 3>& t) {
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return true;
    return sliverness(surface.at(t[0]), surface.at(t[1]), surface.at(t[2])) > kNoArea;
}

namespace {

// Some of its corners lie off a line in the file's doubles.
bool has_area_in_file(const Surface& surface, std::uint32_t face) {
    const PolygonMesh& m = surface.mesh();
    const auto at = [&](std::size_t corner) {
        return surface.framing().normalise(
            m.positions[static_cast<std::size_t>(m.corners[corner].position)]);
    };
    for (std::size_t c = m.face_begin[face] + 1; c + 1 < m.face_end(face); ++c)
        if (sliverness(at(m.face_begin[face]), at(c), at(c + 1)) <= kNoArea) return true;
    return false;
}

} // namespace

void examine_shapes(const Surface& surface, Findings& findings) {
    constexpr double kSliver = 1000; // longest edge / height
    Tally zero, collapsed, slivers;
    for (std::uint32_t f = 0; f < surface.mesh().faces(); ++f) {
        if (surface.has_area(f) || !surface.usable().face[f]) continue;
        (has_area_in_file(surface, f) ? collapsed : zero).add(0, at_face(surface, f));
    }
    for (const Surface::Triangle& t : surface.triangles()) {
        const double value =
            sliverness(surface.at(t.place[0]), surface.at(t.place[1]), surface.at(t.place[2]));
        if (value < kSliver || value > kNoArea) continue;
        slivers.add(value, {t.face, {}, {}, middle_of(surface, t)});
        findings.mark(t.face, Hazard::slivers);
    }
    findings.add(Hazard::zero_areas, zero);
    findings.add(Hazard::collapsed_faces, collapsed);
    findings.add(Hazard::slivers, slivers);
}

} // namespace scanout::geom
