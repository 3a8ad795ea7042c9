// Unweighted area sampling: a primitive counts by the exact area that it shows in the pixel's box
// (raster/tile/area.h). It is shaded once a pixel.
#include "frame/anti_aliasing.h"

namespace scanout::frame::aa {

extern const AntiAliasing area;
constinit const AntiAliasing area{
    .card = {.axis = "aa",
             .name = "area",
             .blurb = "exact areas in the pixel's box: no error of coverage",
             .source = "Catmull 1978",
             .kind = Kind::rung},
    .exact = true};

} // namespace scanout::frame::aa
