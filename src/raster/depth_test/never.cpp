// Depth test "never", of reversed depth, where greater is nearer. [C 1.6].
#include "raster/visible_rule.h"

namespace scanout::raster::depth_test {

extern const DepthTestRow never;
constinit const DepthTestRow never{{.axis = "depth_test",
                                    .name = "never",
                                    .blurb = "nothing",
                                    .source = "[C 1.6]",
                                    .kind = Kind::model},
                                   DepthTest::never};

} // namespace scanout::raster::depth_test
