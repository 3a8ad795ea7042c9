// Depth tests of reversed depth, where greater is nearer [Primer 1.6]. The arithmetic is in
// raster/coverage/depth_rule.h.
#include "rows.h"

#include "raster/coverage/depth_rule.h"

namespace scanout::raster::depth_test {

namespace {

constexpr Technique card(std::string_view name, std::string_view blurb,
                         std::string_view source = "Segal and Akeley 1992") {
    return {"depth_test", name, blurb, source, Kind::model};
}

} // namespace

constinit const DepthTestRow equal{
    card("equal", "depth equal to the buffer's, which starts empty: nothing passes, as with never"),
    DepthTest::equal, false, false};

constinit const DepthTestRow always{
    card("always", "every fragment passes: the last in the file is seen"), DepthTest::always,
    false};

constinit const DepthTestRow never{card("never", "nothing"), DepthTest::never, false, false};

constinit const DepthTestRow less{card("less", "the farthest, at a tie the first in the file"),
                                  DepthTest::less};

constinit const DepthTestRow less_equal{
    card("less_equal", "the farthest, at a tie the last in the file"), DepthTest::less_equal};

constinit const DepthTestRow greater_equal{
    card("greater_equal", "the nearest, at a tie the last in the file"), DepthTest::greater_equal};

constinit const DepthTestRow greater{card("greater", "the nearest, at a tie the first in the file",
                                          "Catmull 1974; Segal and Akeley 1992"),
                                     DepthTest::greater};

} // namespace scanout::raster::depth_test
