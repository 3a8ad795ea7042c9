// Depth in a float, 1 - near / distance: its finest steps lie where nothing is, before the near
// plane.
#include "raster/coverage/depth_rule.h"

namespace scanout::raster::depth {

extern const DepthFormatRow float_32;
constinit const DepthFormatRow float_32{
    {.axis = "depth",
     .name = "float_32",
     .blurb = "a float that grows with the distance: no better than 24 bits, steps of a thousandth",
     .source = "Lapidous and Jiao 1999",
     .kind = Kind::rung},
    true,
    0};

} // namespace scanout::raster::depth
