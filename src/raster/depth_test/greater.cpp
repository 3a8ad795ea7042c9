// Depth test "greater", of reversed depth, where greater is nearer. [Primer 1.6].
#include "raster/coverage/depth_rule.h"

namespace scanout::raster::depth_test {

extern const DepthTestRow greater;
constinit const DepthTestRow greater{{.axis = "depth_test",
                                      .name = "greater",
                                      .blurb = "the nearest, at a tie the first in the file",
                                      .source = "Catmull 1974; Segal and Akeley 1992",
                                      .kind = Kind::model},
                                     DepthTest::greater};

} // namespace scanout::raster::depth_test
