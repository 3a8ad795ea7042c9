// Which faces are left out: rows of raster/culling/cull.h, which has the arithmetic.
#include "rows.h"

#include "raster/culling/cull.h"

namespace scanout::raster::cull {

namespace {

constexpr Technique card(std::string_view name, std::string_view blurb, std::string_view source) {
    return {"cull", name, blurb, source, Kind::model};
}

} // namespace

// Culling "none": what is closed hides its own backs, and files do not say what is.
constinit const CullRow none{
    card("none", "every face, whichever way it is wound", "Segal and Akeley 1992"), Facing::any};

// Culling "back": half the work on closed models, and a look into rooms. [Primer 1.6].
constinit const CullRow back{card("back", "faces wound clockwise on the screen are left out",
                                  "Roberts 1963; Segal and Akeley 1992"),
                             Facing::front};

// Culling "front": the insides of closed models alone. [Primer 1.6].
constinit const CullRow front{card("front",
                                   "faces wound counter-clockwise on the screen are left out",
                                   "Segal and Akeley 1992"),
                              Facing::back};

} // namespace scanout::raster::cull
