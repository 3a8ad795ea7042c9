// Normals that point behind their faces, that are zero, not of unit length, or missing.
#include "geom/diagnose/families.h"

#include <algorithm>
#include <cmath>

namespace scanout::geom {
namespace {

void examine_lengths(const Surface& surface, Findings& findings) {
    constexpr double kUnit = 0.01; // files with two decimals are still unit
    Tally wrong;
    const std::vector<Vec3>& normals = surface.mesh().normals;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const DVec3 n(normals[i]);
        const double length = std::sqrt(dot3(n, n));
        if (!(length > 0) || !std::isfinite(length) || std::abs(length - 1) <= kUnit) continue;
        HazardPlace place;
        place.position = static_cast<std::uint32_t>(i);
        wrong.add(std::max(length, 1 / length), place);
    }
    const auto worst = wrong.place().position;
    const double length =
        worst ? std::sqrt(dot3(DVec3(normals[*worst]), DVec3(normals[*worst]))) : 0;
    findings.add(Hazard::long_normals, wrong, length);
}

} // namespace

void examine_normals(const Surface& surface, Findings& findings) {
    constexpr double kDegrees = 57.29577951308232;
    const PolygonMesh& m = surface.mesh();
    if (m.normals.empty()) return;
    Tally opposite, zero, missing;
    for (std::uint32_t f = 0; f < m.faces(); ++f) {
        if (!surface.has_area(f)) continue;
        const DVec3 face = surface.normal(f);
        const double area = std::sqrt(dot3(face, face));
        for (std::size_t c = m.face_begin[f]; c < m.face_end(f); ++c) {
            const auto place = [&] {
                return HazardPlace{f,
                                   {},
                                   static_cast<std::uint32_t>(m.corners[c].position),
                                   file_position(surface, surface.corner_place(c))};
            };
            if (m.corners[c].normal < 0) {
                missing.add(0, place());
                findings.mark(f, Hazard::missing_normals);
                continue;
            }
            const DVec3 n(m.normals[static_cast<std::size_t>(m.corners[c].normal)]);
            const double length = std::sqrt(dot3(n, n));
            if (!(length > 0) || !std::isfinite(length)) {
                zero.add(0, place());
                findings.mark(f, Hazard::zero_normals);
            } else if (const double cosine = dot3(face, n) / (area * length); cosine < 0) {
                opposite.add(std::acos(std::max(cosine, -1.0)) * kDegrees, place());
                findings.mark(f, Hazard::opposite_normals);
            }
        }
    }
    findings.add(Hazard::opposite_normals, opposite);
    findings.add(Hazard::zero_normals, zero);
    findings.add(Hazard::missing_normals, missing);
    examine_lengths(surface, findings);
}

} // namespace scanout::geom
