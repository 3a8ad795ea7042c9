// Culling "back": half the work on closed models, and a look into rooms. [Primer 1.6].
#include "raster/culling/cull.h"

namespace scanout::raster::cull {

extern const CullRow back;
constinit const CullRow back{{.axis = "cull",
                              .name = "back",
                              .blurb = "faces wound clockwise on the screen are left out",
                              .source = "Roberts 1963; Segal and Akeley 1992",
                              .kind = Kind::model},
                             Facing::front};

} // namespace scanout::raster::cull
