// Depth test "less_equal", of reversed depth, where greater is nearer. [Primer 1.6].
#include "raster/coverage/depth_rule.h"

namespace scanout::raster::depth_test {

extern const DepthTestRow less_equal;
constinit const DepthTestRow less_equal{{.axis = "depth_test",
                                         .name = "less_equal",
                                         .blurb = "the farthest, at a tie the last in the file",
                                         .source = "Segal and Akeley 1992",
                                         .kind = Kind::model},
                                        DepthTest::less_equal};

} // namespace scanout::raster::depth_test
