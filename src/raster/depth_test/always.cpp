// Depth test "always", of reversed depth, where greater is nearer. [Primer 1.6].
#include "raster/coverage/depth_rule.h"

namespace scanout::raster::depth_test {

extern const DepthTestRow always;
constinit const DepthTestRow always{{.axis = "depth_test",
                                     .name = "always",
                                     .blurb = "the last in the file, whatever its depth",
                                     .source = "Segal and Akeley 1992",
                                     .kind = Kind::model},
                                    DepthTest::always,
                                    false};

} // namespace scanout::raster::depth_test
