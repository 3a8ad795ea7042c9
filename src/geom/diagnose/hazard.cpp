#include "geom/diagnose/hazard.h"

#include <array>
#include <cstddef>

namespace scanout::geom {
namespace {

constexpr auto kWarning = Severity::warning, kNote = Severity::note;

// Rows: hazard, name, severity, one, many, measure, advice, mended. Lengths are the file's.
constexpr std::array kCards = std::to_array<HazardCard>({
    {Hazard::not_finite, "not-finite", kWarning, "position is not three finite numbers",
     "positions are not three finite numbers", "", "write the file anew: its faces are left out"},
    {Hazard::collapsed_faces, "collapsed-faces", kWarning,
     "face has an area that no float can tell", "faces have an area that no float can tell", "",
     "cut the model into parts: it holds details of less than 2^-24 of its size"},
    {Hazard::t_vertices, "t-vertices", kWarning, "vertex lies within another face's edge",
     "vertices lie within other faces' edges", "off by up to {:.3g}",
     "split these edges: --fix does, and moves no vertex", true},
    {Hazard::cracks, "cracks", kWarning, "open vertex lies close to another one",
     "open vertices lie close to others", "up to {:.3g} wide",
     "merge vertices by distance in a modeller"},
    {Hazard::duplicate_faces, "duplicate-faces", kWarning, "face repeats another one",
     "faces repeat others", "", "remove them: --fix does", true},
    {Hazard::overlaps, "overlaps", kWarning, "pair of triangles overlaps in one plane",
     "pairs of triangles overlap in one plane", "the nearest {:.3g} apart",
     "remove one of them, or move them apart: elsewhere chance shows one (z-fighting)"},
    {Hazard::mixed_winding, "mixed-winding", kWarning, "edge joins faces of opposite winding",
     "edges join faces of opposite winding", "", "make the winding consistent: --fix does", true},
    {Hazard::flipped_shells, "flipped-shells", kWarning, "closed shell is inside out",
     "closed shells are inside out", "the largest of {:.0f} triangles",
     "turn its faces around: --fix does", true},
    {Hazard::opposite_normals, "opposite-normals", kWarning,
     "corner's normal points behind its face", "corners' normals point behind their faces",
     "by up to {:.0f} degrees", "recalculate the normals, or leave them out"},
    {Hazard::zero_normals, "zero-normals", kWarning, "corner's normal is zero or not finite",
     "corners' normals are zero or not finite", "",
     "recalculate the normals: these are made from the faces"},
    {Hazard::missing_uvs, "missing-uvs", kWarning, "textured face has no texture coordinates",
     "textured faces have no texture coordinates", "", "unwrap these faces"},
    {Hazard::degenerate_uvs, "degenerate-uvs", kWarning,
     "textured face shows a line or a point of its texture",
     "textured faces show a line or a point of their texture", "", "unwrap these faces"},
    {Hazard::intersections, "intersections", kNote, "pair of triangles intersects",
     "pairs of triangles intersect", "", "drawn exactly; unite the parts where they are printed"},
    {Hazard::non_manifold_edges, "non-manifold-edges", kNote, "edge is used by more than two faces",
     "edges are used by more than two faces", "up to {:.0f} faces",
     "separate the parts that meet there"},
    {Hazard::open_edges, "open-edges", kNote, "edge is used by one face alone",
     "edges are used by one face alone", "", "close the holes, if it is a solid"},
    {Hazard::zero_areas, "zero-areas", kNote, "face has no area", "faces have no area", "",
     "remove them: --fix does; they are never drawn", true},
    {Hazard::slivers, "slivers", kNote, "triangle is a sliver or a needle",
     "triangles are slivers or needles", "longest edge up to {:.3g} times the height",
     "drawn exactly; interpolated normals may flicker"},
    {Hazard::back_to_back, "back-to-back", kNote, "face lies on another one, turned around",
     "faces lie on others, turned around", "", "keep one of each, and cull nothing"},
    {Hazard::long_normals, "long-normals", kNote, "normal is not of unit length",
     "normals are not of unit length", "length {:.3g}", "they are made so when the file is read"},
    {Hazard::missing_normals, "missing-normals", kNote, "corner has no normal, while others have",
     "corners have no normal, while others have", "", "they are made from the faces"},
    {Hazard::large_uvs, "large-uvs", kNote, "corner's texture coordinate is far from 0",
     "corners' texture coordinates are far from 0", "up to {:.3g}",
     "move them by whole repeats: floats lose their digits in other programs"},
    {Hazard::unreferenced, "unreferenced", kNote, "position is used by nothing",
     "positions are used by nothing", "", "remove them: --fix does", true},
    {Hazard::denormals, "denormals", kNote, "position holds a number that is no normal float",
     "positions hold numbers that are no normal floats", "",
     "choose another unit: many programs read 0"},
    {Hazard::far_from_origin, "far-from-origin", kNote,
     "model lies so far from the origin that floats lose its details",
     "models lie so far from the origin that floats lose their details", "steps of {:.3g}",
     "drawn exactly; move it to the origin for programs that keep floats"},
    {Hazard::unusual_unit, "unusual-unit", kNote, "model has an unusual size",
     "models have an unusual size", "radius {:.3g}", "choose another unit; drawn alike in any"},
    {Hazard::small_triangles, "small-triangles", kNote, "triangle is smaller than a pixel",
     "triangles are smaller than a pixel", "", "simplify the model, or draw it larger"},
});
static_assert([] {
    for (std::size_t i = 0; i < kCards.size(); ++i)
        if (static_cast<std::size_t>(kCards[i].hazard) != i) return false;
    return kCards.size() == static_cast<std::size_t>(Hazard::small_triangles) + 1;
}());

} // namespace

std::span<const HazardCard> hazard_cards() {
    return kCards;
}

const HazardCard& card_of(Hazard hazard) {
    return kCards[static_cast<std::size_t>(hazard)];
}

} // namespace scanout::geom
