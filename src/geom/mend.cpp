#include "geom/mend.h"

#include "geom/diagnose/same_faces.h"
#include "geom/diagnose/surface.h"
#include "geom/mend_seams.h"
#include "geom/mend_winding.h"

#include <algorithm>

namespace scanout::geom {
namespace {

// Keeps the faces and corners that are marked, in their order.
void filter_faces(PolygonMesh& m, const std::vector<bool>& keep_face,
                  const std::vector<bool>& keep_corner) {
    std::size_t faces = 0, corners = 0;
    for (std::size_t f = 0; f < m.faces(); ++f) {
        const std::size_t begin = m.face_begin[f], end = m.face_end(f);
        if (!keep_face[f]) continue;
        const std::size_t first = corners;
        for (std::size_t c = begin; c < end; ++c)
            if (keep_corner[c]) m.corners[corners++] = m.corners[c];
        m.face_begin[faces] = static_cast<std::uint32_t>(first); // at or before f: read already
        m.face_material[faces] = m.face_material[f];
        if (!m.face_smoothing.empty()) m.face_smoothing[faces] = m.face_smoothing[f];
        ++faces;
    }
    m.face_begin.resize(faces);
    m.face_material.resize(faces);
    if (!m.face_smoothing.empty()) m.face_smoothing.resize(faces);
    m.corners.resize(corners);
}
void filter_faces(PolygonMesh& m, const std::vector<bool>& keep_face) {
    filter_faces(m, keep_face, std::vector<bool>(m.corners.size(), true));
}
std::size_t count_of(const std::vector<bool>& flags, bool value) {
    return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), value));
}

// Positions at one place become the first of them, unless their colours differ; what nothing uses
// goes.
void weld(const Surface& surface, PolygonMesh& m, Mended& report) {
    constexpr std::uint32_t kGone = 0xffffffff;
    std::vector<std::uint32_t> number(m.positions.size(), kGone);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < m.positions.size(); ++i) {
        const std::uint32_t place = surface.place_of(i);
        if (place == kNoPlace) {
            ++report.unused;
            continue;
        }
        const std::uint32_t first = surface.position_of(place);
        const bool alike = m.colours.empty() || m.colours[first] == m.colours[i];
        if (first != i && number[first] != kGone && alike) {
            number[i] = number[first];
            ++report.welded;
            continue;
        }
        number[i] = static_cast<std::uint32_t>(kept);
        ++kept;
    }
    std::vector<DVec3> positions(kept);
    std::vector<Vec3> colours(m.colours.empty() ? 0 : kept);
    for (std::size_t i = m.positions.size(); i-- > 0;) {
        if (number[i] == kGone) continue;
        positions[number[i]] = m.positions[i];
        if (!colours.empty()) colours[number[i]] = m.colours[i];
    }
    const auto moved = [&](auto& index) { index = number[static_cast<std::size_t>(index)]; };
    for (Corner& c : m.corners)
        c.position = static_cast<std::int32_t>(number[static_cast<std::size_t>(c.position)]);
    std::for_each(m.line_vertices.begin(), m.line_vertices.end(), moved);
    std::for_each(m.point_vertices.begin(), m.point_vertices.end(), moved);
    m.positions = std::move(positions);
    m.colours = std::move(colours);
}

void remove_unusable(const Surface& surface, PolygonMesh& m, Mended& report) {
    report.degenerate += count_of(surface.usable().face, false);
    filter_faces(m, surface.usable().face);
    // Lines and points with a position that is not finite.
    const auto bad = [&](std::uint32_t p) { return surface.place_of(p) == kNoPlace; };
    std::vector<std::uint32_t> vertices, begins;
    std::vector<std::int32_t> materials;
    for (std::size_t i = 0; i < m.line_begin.size(); ++i) {
        const auto begin = m.line_vertices.begin() + m.line_begin[i];
        const auto end = i + 1 < m.line_begin.size() ? m.line_vertices.begin() + m.line_begin[i + 1]
                                                     : m.line_vertices.end();
        if (std::any_of(begin, end, bad)) continue;
        begins.push_back(static_cast<std::uint32_t>(vertices.size()));
        materials.push_back(m.line_material[i]);
        vertices.insert(vertices.end(), begin, end);
    }
    m.line_vertices = std::move(vertices);
    m.line_begin = std::move(begins);
    m.line_material = std::move(materials);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < m.point_vertices.size(); ++i)
        if (!bad(m.point_vertices[i])) {
            m.point_vertices[kept] = m.point_vertices[i];
            m.point_material[kept++] = m.point_material[i];
        }
    m.point_vertices.resize(kept);
    m.point_material.resize(kept);
}

// Of a face that stays, corners at the place of the next one go.
void remove_degenerate(Jobs& jobs, PolygonMesh& m, Mended& report) {
    const Surface surface(jobs, m);
    const std::vector<bool>& keep = surface.faces_with_area();
    std::vector<bool> keep_corner(m.corners.size());
    for (std::size_t f = 0; f < m.faces(); ++f)
        for (std::size_t c = m.face_begin[f]; c < m.face_end(f); ++c)
            keep_corner[c] =
                surface.corner_place(c) != surface.corner_place(surface.next_corner(f, c));
    report.degenerate += count_of(keep, false);
    filter_faces(m, keep, keep_corner);
}

void remove_repeated(Jobs& jobs, PolygonMesh& m, Mended& report) {
    std::vector<bool> keep(m.faces(), true);
    const Surface surface(jobs, m);
    for (const SameFace& same : surface.same_faces())
        keep[same.face] = same.turned;
    report.repeated += count_of(keep, false);
    filter_faces(m, keep);
}

} // namespace

Mended mend(Jobs& jobs, PolygonMesh& mesh, double tolerance,
            const std::function<void(double share)>& progress) {
    Mended report;
    constexpr double kSteps = 6;
    int steps = 0;
    const auto tell = [&] {
        if (progress) progress(++steps / kSteps);
    };
    {
        const Surface surface(jobs, mesh);
        remove_unusable(surface, mesh, report);
    }
    tell();
    remove_degenerate(jobs, mesh, report);
    tell();
    remove_repeated(jobs, mesh, report);
    tell();
    report.split = split_t_vertices(jobs, mesh, tolerance).corners;
    if (report.split > 0) { // of two faces, one may have had the other's T-vertices
        remove_degenerate(jobs, mesh, report);
        remove_repeated(jobs, mesh, report);
    }
    tell();
    make_winding_alike(jobs, mesh, report);
    tell();
    const Surface surface(jobs, mesh);
    weld(surface, mesh, report);
    tell();
    return report;
}

} // namespace scanout::geom
