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

std::vector<bool> faces_with_area(const Surface& surface) {
    std::vector<bool> with(surface.mesh().faces(), false);
    for (const Surface::Triangle& t : surface.triangles())
        if (!has_no_area(surface, t.place)) with[t.face] = true;
    return with;
}

void examine_shapes(const Surface& surface, Findings& findings) {
    constexpr double kSliver = 1000; // longest edge / height
    Tally zero, slivers;
    const std::vector<bool> with_area = faces_with_area(surface);
    for (std::uint32_t f = 0; f < with_area.size(); ++f) {
        if (with_area[f] || !surface.usable().face[f]) continue;
        zero.add(0, at_face(surface, f));
        findings.mark(f, Hazard::zero_areas);
    }
    for (const Surface::Triangle& t : surface.triangles()) {
        const double value =
            sliverness(surface.at(t.place[0]), surface.at(t.place[1]), surface.at(t.place[2]));
        if (value < kSliver || value > kNoArea) continue;
        slivers.add(value, {t.face, {}, {}, middle_of(surface, t)});
        findings.mark(t.face, Hazard::slivers);
    }
    findings.add(Hazard::zero_areas, zero);
    findings.add(Hazard::slivers, slivers);
}

} // namespace scanout::geom
