// Culling "none": what is closed hides its own backs, and files do not say what is.
#include "raster/culling/cull.h"

namespace scanout::raster::cull {

extern const CullRow none;
constinit const CullRow none{{.axis = "cull",
                              .name = "none",
                              .blurb = "every face, whichever way it is wound",
                              .source = "Segal and Akeley 1992",
                              .kind = Kind::model},
                             Facing::any};

} // namespace scanout::raster::cull
