// Culling "front": the insides of closed models alone. [Primer 1.6].
#include "raster/culling/cull.h"

namespace scanout::raster::cull {

extern const CullRow front;
constinit const CullRow front{{.axis = "cull",
                               .name = "front",
                               .blurb = "faces wound counter-clockwise on the screen are left out",
                               .source = "Segal and Akeley 1992",
                               .kind = Kind::model},
                              Facing::back};

} // namespace scanout::raster::cull
