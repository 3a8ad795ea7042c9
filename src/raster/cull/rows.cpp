// Face culling modes. The arithmetic is in raster/culling/cull.h.
#include "rows.h"

#include "raster/culling/cull.h"

namespace scanout::raster::cull {

namespace {

constexpr Technique card(std::string_view name, std::string_view blurb, std::string_view source) {
    return {"cull", name, blurb, source, Kind::model};
}

} // namespace

// Culling "material": a file may say which surfaces have a back that is meant to be seen. The plan
// makes it `none` or `back` where the materials are of one mind.
constinit const CullRow material{
    card("material", "back faces of materials that are one-sided, as glTF says, are left out",
         "Khronos 2021"),
    Facing::any};

// Culling "none": closed models hide their own back faces, and files do not say which are closed.
constinit const CullRow none{
    card("none", "every face, whichever way it is wound", "Segal and Akeley 1992"), Facing::any};

// Culling "back": half the work on closed models, and a view into rooms from outside. [Primer 1.6].
constinit const CullRow back{card("back", "faces wound clockwise on the screen are left out",
                                  "Roberts 1963; Segal and Akeley 1992"),
                             Facing::front};

// Culling "front": shows only the insides of closed models. [Primer 1.6].
constinit const CullRow front{card("front",
                                   "faces wound counter-clockwise on the screen are left out",
                                   "Segal and Akeley 1992"),
                              Facing::back};

} // namespace scanout::raster::cull
