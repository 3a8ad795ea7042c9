// Depth in 24 bits: 1 - near / distance in 2^24 - 1 steps, as most depth buffers had it for years.
// At a ratio of 1e7 it loses 19 % of all pairs a hundredth apart, 76 % of those a millionth apart.
#include "raster/coverage/depth_rule.h"

namespace scanout::raster::depth {

extern const DepthFormatRow fixed_24;
constinit const DepthFormatRow fixed_24{
    {.axis = "depth",
     .name = "fixed_24",
     .blurb = "24 bits: around the target, steps of a thousandth of its distance",
     .source = "Catmull 1974; Lapidous and Jiao 1999",
     .kind = Kind::rung},
    true,
    16777215};

} // namespace scanout::raster::depth
