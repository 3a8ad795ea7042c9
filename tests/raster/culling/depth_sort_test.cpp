// A tile's large triangles in the order in which they are drawn: all of them, once, and no one
// before another that is clearly nearer.
#include "raster/culling/depth_sort.h"
#include "support/random.h"
#include "support/targets.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::raster::test {
namespace {

float depth_in(DepthAndId of) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(of >> 32));
}

TEST(DepthSort, NoneComesBeforeOneThatIsClearlyNearer) {
    scanout::test::on_every_target([](const std::string&) {
        scanout::test::Random random(7);
        for (int count = 0; count <= 200; ++count) {
            std::vector<DepthAndId> triangles;
            for (int i = 0; i < count; ++i) {
                // Many sizes, some as near as others, some at 0.
                const double depth =
                    std::ldexp(1.0 + random.whole(0, 9) / 10.0, -random.whole(1, 40));
                triangles.push_back(
                    depth_and_id(random.whole(0, 9) == 0 ? 0.0F : static_cast<float>(depth),
                                 static_cast<std::uint32_t>(random.bits())));
            }
            std::vector<DepthAndId> all = triangles;
            sort_front_to_back(triangles);
            for (std::size_t i = 1; i < triangles.size(); ++i)
                EXPECT_GE(depth_in(triangles[i - 1]), depth_in(triangles[i]) * (1 - 0x1p-16F)) << i;
            std::vector<DepthAndId> ordered = triangles;
            std::sort(all.begin(), all.end());
            std::sort(ordered.begin(), ordered.end());
            EXPECT_TRUE(all == ordered) << count;
        }
    });
}

TEST(DepthSort, AnIdIsWhatItWas) {
    EXPECT_EQ(id_of(depth_and_id(0.5F, 0xfedcba98)), 0xfedcba98);
    EXPECT_EQ(depth_in(depth_and_id(0.375F, 0xffffffff)), 0.375F);
}

} // namespace
} // namespace scanout::raster::test
