// Depth test "equal", of reversed depth, where greater is nearer. [Primer 1.6].
#include "raster/coverage/depth_rule.h"

namespace scanout::raster::depth_test {

extern const DepthTestRow equal;
constinit const DepthTestRow equal{
    {.axis = "depth_test",
     .name = "equal",
     .blurb =
         "only what lies as deep as what is kept: the buffer starts empty, so nothing, as never",
     .source = "Segal and Akeley 1992",
     .kind = Kind::model},
    DepthTest::equal,
    false,
    false};

} // namespace scanout::raster::depth_test
