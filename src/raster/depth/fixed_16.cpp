// Depth in 16 bits: 1 - near / distance in 65535 steps. At a ratio of distances of 1e7 it tells
// apart less than half of all pairs that lie a hundredth apart, and none a millionth apart. Near is
// 1/16384 of the distance to the target: a step there is 16384/65535 of it, so that the nearest and
// the farthest side of a model may fall into one, and the lower id is seen.
#include "raster/coverage/depth_rule.h"

namespace scanout::raster::depth {

extern const DepthFormatRow fixed_16;
constinit const DepthFormatRow fixed_16{
    {.axis = "depth",
     .name = "fixed_16",
     .blurb = "16 bits, from near to infinitely far: around the target, steps of a quarter of its "
              "distance",
     .source = "Catmull 1974",
     .kind = Kind::rung},
    true,
    65535};

} // namespace scanout::raster::depth
