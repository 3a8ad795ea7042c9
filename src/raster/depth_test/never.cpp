// Depth test "never", of reversed depth, where greater is nearer. [Primer 1.6].
#include "raster/coverage/depth_rule.h"

namespace scanout::raster::depth_test {

extern const DepthTestRow never;
constinit const DepthTestRow never{{.axis = "depth_test",
                                    .name = "never",
                                    .blurb = "nothing",
                                    .source = "Segal and Akeley 1992",
                                    .kind = Kind::model},
                                   DepthTest::never,
                                   false,
                                   false};

} // namespace scanout::raster::depth_test
