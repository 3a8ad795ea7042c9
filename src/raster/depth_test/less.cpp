// Depth test "less", of reversed depth, where greater is nearer. [Primer 1.6].
#include "raster/coverage/depth_rule.h"

namespace scanout::raster::depth_test {

extern const DepthTestRow less;
constinit const DepthTestRow less{{.axis = "depth_test",
                                   .name = "less",
                                   .blurb = "the farthest, at a tie the first in the file",
                                   .source = "Segal and Akeley 1992",
                                   .kind = Kind::model},
                                  DepthTest::less};

} // namespace scanout::raster::depth_test
