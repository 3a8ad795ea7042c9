// One-sided lighting: normals stay as the file has them. A surface that is seen from behind shows
// the light of its front; on closed bodies, seen from outside, no surface is.
#include "shade/sides.h"

namespace scanout::shade::sides {

extern const LitSides one_sided;
constinit const LitSides one_sided{{.axis = "sides",
                                    .name = "one_sided",
                                    .blurb = "the side that the file's normals point to is lit",
                                    .source = "Segal and Akeley 1992",
                                    .kind = Kind::effect},
                                   Sides::file,
                                   Sides::file};

} // namespace scanout::shade::sides
