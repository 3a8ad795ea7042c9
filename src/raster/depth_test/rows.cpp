// Depth tests by the names of OpenGL and Direct3D, where a depth that is less is nearer
// [Primer 1.6]. The arithmetic is in
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

constinit const DepthTestRow not_equal{
    card("not_equal", "the last in the file, and of a run of the same depth before it the first"),
    DepthTest::not_equal, false};

constinit const DepthTestRow always{
    card("always", "every fragment passes: the last in the file is seen"), DepthTest::always,
    false};

constinit const DepthTestRow never{card("never", "nothing"), DepthTest::never, false, false};

constinit const DepthTestRow greater{
    card("greater", "the farthest, at a tie the first in the file"), DepthTest::greater};

constinit const DepthTestRow greater_equal{
    card("greater_equal", "the farthest, at a tie the last in the file"), DepthTest::greater_equal};

constinit const DepthTestRow less_equal{
    card("less_equal", "the nearest, at a tie the last in the file"), DepthTest::less_equal};

constinit const DepthTestRow less{card("less", "the nearest, at a tie the first in the file",
                                       "Catmull 1974; Segal and Akeley 1992"),
                                  DepthTest::less};

} // namespace scanout::raster::depth_test
