// Which side of a face is lit: rows of what the interpolation does with normals.
#include "rows.h"

#include "shade/sides.h"

namespace scanout::shade::sides {

namespace {

constexpr Technique card(std::string_view name, std::string_view blurb) {
    return {"sides", name, blurb, "Segal and Akeley 1992", Kind::effect};
}

} // namespace

// One-sided lighting: normals stay as the file has them. A surface that is seen from behind shows
// the light of its front; on closed bodies, seen from outside, no surface is.
constinit const LitSides one_sided{
    card("one_sided", "the side that the file's normals point to is lit"), Sides::file,
    Sides::file};

// Two-sided lighting: the normals of a face are turned to the side that the eye sees, once a face
// (shade/setup/triangle_setup-inl.h): by its winding on the screen, but where some file winds
// faces the wrong way round, by its normals.
constinit const LitSides two_sided{card("two_sided", "the side that the eye sees is lit"),
                                   Sides::eye, Sides::face};

} // namespace scanout::shade::sides
