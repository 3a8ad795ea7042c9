// Culling "back": half the work on closed models, and a look into rooms. [C 1.6].
#include "raster/cull.h"

namespace scanout::raster::culling {

extern const CullRow back;
constinit const CullRow back{{.axis = "cull",
                              .name = "back",
                              .blurb = "faces wound clockwise on the screen are left out",
                              .source = "[C 1.6]",
                              .kind = Kind::model},
                             Facing::front};

} // namespace scanout::raster::culling
