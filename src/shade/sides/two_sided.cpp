// Two-sided lighting: normals are turned to the side that the eye sees, whichever way the file
// wound the face. Where all normals of a face lie on one side of it that is decided once a face,
// from its winding on the screen (shade/primitives.cpp, shade/lane_triangles.cpp), else at every
// lane (shade/interpolate/interpolate-inl.h).
#include "shade/sides.h"

namespace scanout::shade::sides {

extern const LitSides two_sided;
constinit const LitSides two_sided{{.axis = "sides",
                                    .name = "two_sided",
                                    .blurb = "the side that the eye sees is lit",
                                    .source = "Segal and Akeley 1992",
                                    .kind = Kind::effect},
                                   Sides::eye,
                                   Sides::face};

} // namespace scanout::shade::sides
