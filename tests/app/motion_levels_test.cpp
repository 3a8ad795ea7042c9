#include "app/motion_levels.h"

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

TEST(MotionLevels, AreTheOwnScaleAndEachSmallerOneTheBestFirst) {
    frame::FrameOptions options;
    const std::vector<MotionLevel> of_full = motion_levels(options, true);
    ASSERT_EQ(of_full.size(), 6U);
    EXPECT_EQ(of_full[0].render_scale, "");
    EXPECT_EQ(of_full[1].render_scale, "three_quarters");
    EXPECT_DOUBLE_EQ(of_full[1].share, 9 / 16.0);
    EXPECT_EQ(of_full[5].render_scale, "quarter");
    EXPECT_DOUBLE_EQ(of_full[5].share, 1 / 16.0);
    options.render_scale = "half";
    const std::vector<MotionLevel> of_half = motion_levels(options, true);
    ASSERT_EQ(of_half.size(), 3U);
    EXPECT_EQ(of_half[1].render_scale, "third");
    EXPECT_DOUBLE_EQ(of_half[1].share, 4 / 9.0);
    for (std::size_t i = 1; i < of_full.size(); ++i)
        EXPECT_LT(of_full[i].share, of_full[i - 1].share);
}

TEST(MotionLevels, AScaleThatTheUserNamedStays) {
    EXPECT_EQ(motion_levels({}, false).size(), 1U);
}

} // namespace
} // namespace scanout::app
