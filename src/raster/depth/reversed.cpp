// Reversed depth, near / distance in a float: steps of 2^-24 of the distance, near and far.
// Lapidous and Jiao 1999; HARD-CASES L2.
#include "raster/coverage/depth_rule.h"

namespace scanout::raster::depth {

extern const DepthFormatRow reversed;
constinit const DepthFormatRow reversed{
    {.axis = "depth",
     .name = "reversed",
     .blurb = "a float that falls with the distance: the same precision everywhere",
     .source = "Lapidous and Jiao 1999",
     .kind = Kind::rung},
    false,
    0};

} // namespace scanout::raster::depth
