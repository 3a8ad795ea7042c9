// Texture coordinates: missing or without an area on textured faces, and far from 0.
#include "geom/diagnose/families.h"

#include <algorithm>
#include <cmath>

namespace scanout::geom {
namespace {

// Twice the area that the face covers of its texture, and the square of its longest side there.
struct UvExtent {
    double area = 0, longest = 0;
};
UvExtent extent_of(const PolygonMesh& m, std::uint32_t face) {
    const auto uv = [&](std::size_t c) { return m.uvs[static_cast<std::size_t>(m.corners[c].uv)]; };
    const std::size_t begin = m.face_begin[face], end = m.face_end(face);
    UvExtent extent;
    for (std::size_t c = begin + 1; c < end; ++c) {
        const DVec2 u = uv(c) - uv(begin);
        extent.longest = std::max(extent.longest, u.x * u.x + u.y * u.y);
        if (c + 1 == end) break;
        const DVec2 v = uv(c + 1) - uv(begin);
        extent.area += std::abs(u.x * v.y - u.y * v.x);
    }
    return extent;
}

} // namespace

void examine_uvs(const Surface& surface, const DiagnoseOptions& how, Findings& findings) {
    constexpr double kFar = 64;        // repeats: a float still has 2^-18 of one
    constexpr double kNoUvArea = 1e-9; // of the square of the longest side
    const PolygonMesh& m = surface.mesh();
    Tally missing, degenerate, large;
    for (std::uint32_t f = 0; f < m.faces(); ++f) {
        if (!surface.has_area(f)) continue;
        bool complete = true;
        for (std::size_t c = m.face_begin[f]; c < m.face_end(f); ++c) {
            if (m.corners[c].uv < 0) {
                complete = false;
                continue;
            }
            const DVec2 uv = m.uvs[static_cast<std::size_t>(m.corners[c].uv)];
            const double most = std::max(std::abs(uv.x), std::abs(uv.y));
            if (!(most > kFar)) continue;
            large.add(most, {f,
                             {},
                             static_cast<std::uint32_t>(m.corners[c].position),
                             file_position(surface, surface.corner_place(c))});
            findings.mark(f, Hazard::large_uvs);
        }
        const auto material = static_cast<std::size_t>(m.face_material[f]); // -1: none
        if (material >= how.textured.size() || !how.textured[material]) continue;
        if (!complete) {
            missing.add(0, at_face(surface, f));
            findings.mark(f, Hazard::missing_uvs);
        } else if (const UvExtent uv = extent_of(m, f); uv.area <= kNoUvArea * uv.longest) {
            degenerate.add(0, at_face(surface, f));
            findings.mark(f, Hazard::degenerate_uvs);
        }
    }
    findings.add(Hazard::missing_uvs, missing);
    findings.add(Hazard::degenerate_uvs, degenerate);
    findings.add(Hazard::large_uvs, large);
}

} // namespace scanout::geom
