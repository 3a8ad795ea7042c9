// Edges that are open or used too often, faces wound against their neighbours, shells inside out.
#include "geom/diagnose/families.h"
#include "geom/diagnose/shells.h"

namespace scanout::geom {
namespace {

// Two faces that use an edge in the same direction.
bool wound_against(std::span<const Surface::EdgeUse> uses) {
    return uses.size() == 2 && uses[0].face != uses[1].face && uses[0].forward == uses[1].forward;
}

void examine_shells(const Surface& surface, Findings& findings) {
    const Shells shells = find_shells(surface);
    Tally flipped;
    for (const Shell& shell : shells.shells)
        if (shell.flipped)
            flipped.add(static_cast<double>(shell.triangles), at_face(surface, shell.first_face));
    for (std::uint32_t f = 0; flipped.count() > 0 && f < shells.of_face.size(); ++f)
        if (shells.of_face[f] != kNoPlace && shells.shells[shells.of_face[f]].flipped)
            findings.mark(f, Hazard::flipped_shells);
    findings.add(Hazard::flipped_shells, flipped);
}

} // namespace

void examine_edges(const Surface& surface, Findings& findings) {
    Tally open, many, mixed;
    surface.for_each_edge([&](std::span<const Surface::EdgeUse> uses) {
        const auto mark = [&](Hazard hazard) {
            for (const Surface::EdgeUse& use : uses)
                findings.mark(use.face, hazard);
        };
        if (uses.size() == 1) {
            open.add(0, at_edge(surface, uses[0]));
            mark(Hazard::open_edges);
        } else if (uses.size() > 2) {
            many.add(static_cast<double>(uses.size()), at_edge(surface, uses[0]));
            mark(Hazard::non_manifold_edges);
        } else if (wound_against(uses)) {
            HazardPlace place = at_edge(surface, uses[0]);
            place.other_face = uses[1].face;
            mixed.add(0, place);
            mark(Hazard::mixed_winding);
        }
    });
    findings.add(Hazard::open_edges, open);
    findings.add(Hazard::non_manifold_edges, many);
    findings.add(Hazard::mixed_winding, mixed);
    examine_shells(surface, findings);
}

} // namespace scanout::geom
