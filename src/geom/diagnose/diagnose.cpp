#include "geom/diagnose/diagnose.h"

#include "geom/diagnose/families.h"

#include <algorithm>
#include <array>

namespace scanout::geom {

void Findings::add(Hazard hazard, const Tally& tally, double measure, double searched) {
    if (tally.count() == 0 && searched >= 1) return;
    const std::lock_guard lock(mutex_);
    out_.findings.push_back({hazard, tally.count(), measure, tally.place(), searched});
}

DVec3 file_position(const Surface& surface, std::uint32_t place) {
    return surface.mesh().positions[surface.position_of(place)];
}

DVec3 middle_of(const Surface& surface, const Surface::Triangle& t) {
    DVec3 sum(0);
    for (const std::uint32_t place : t.place)
        sum += file_position(surface, place) / 3.0;
    return sum;
}

HazardPlace at_face(const Surface& surface, std::uint32_t face) {
    const PolygonMesh& m = surface.mesh();
    const std::size_t begin = m.face_begin[face], end = m.face_end(face);
    DVec3 sum(0);
    for (std::size_t c = begin; c < end; ++c)
        sum += file_position(surface, surface.corner_place(c)) / static_cast<double>(end - begin);
    return {face, {}, {}, sum};
}

HazardPlace at_edge(const Surface& surface, const Surface::EdgeUse& use) {
    return {use.face,
            {},
            surface.position_of(use.low),
            file_position(surface, use.low) * 0.5 + file_position(surface, use.high) * 0.5};
}

Diagnosis diagnose(Jobs& jobs, const PolygonMesh& mesh, const DiagnoseOptions& how) {
    Diagnosis out;
    out.faces = mesh.faces();
    out.marks.resize(mesh.faces());
    const auto goes_on = [&](double share) {
        out.stopped = out.stopped || (how.progress && !how.progress(share));
        return !out.stopped;
    };
    const Surface surface(jobs, mesh);
    out.triangles = surface.triangles().size();
    if (!goes_on(0.2)) return out;
    Findings findings(out);
    // Each search on a core of its own.
    const std::array<std::function<void()>, 6> searches = {
        [&] { examine_edges(surface, findings); },
        [&] { examine_duplicates(surface, findings); },
        [&] { examine_normals(surface, findings); },
        [&] { examine_shapes(surface, findings); },
        [&] { examine_uvs(surface, how, findings); },
        [&] { examine_numbers(surface, findings); },
    };
    jobs.for_each(static_cast<int>(searches.size()),
                  [&](int i, int) { searches[static_cast<std::size_t>(i)](); });
    if (!goes_on(0.4)) return out;
    if (how.search) {
        examine_seams(surface, how, findings);
        if (goes_on(0.5)) out.stopped = !examine_pairs(surface, how, findings);
    }
    if (out.stopped) return out;
    std::sort(out.findings.begin(), out.findings.end(),
              [](const Finding& a, const Finding& b) { return a.hazard < b.hazard; });
    goes_on(1);
    return out;
}

} // namespace scanout::geom
