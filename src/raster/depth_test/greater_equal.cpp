// Depth test "greater_equal", of reversed depth, where greater is nearer. [Primer 1.6].
#include "raster/coverage/depth_rule.h"

namespace scanout::raster::depth_test {

extern const DepthTestRow greater_equal;
constinit const DepthTestRow greater_equal{{.axis = "depth_test",
                                            .name = "greater_equal",
                                            .blurb = "the nearest, at a tie the last in the file",
                                            .source = "Segal and Akeley 1992",
                                            .kind = Kind::model},
                                           DepthTest::greater_equal};

} // namespace scanout::raster::depth_test
