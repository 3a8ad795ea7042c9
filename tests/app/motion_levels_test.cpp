#include "app/view/motion_levels.h"

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

TEST(MotionLevels, AreTheOwnScaleAndEachSmallerOneTheBestFirst) {
    frame::FrameOptions options;
    const std::vector<MotionLevel> of_full = motion_levels(options, true, true);
    ASSERT_EQ(of_full.size(), 6U);
    EXPECT_EQ(of_full[0].render_scale, "");
    EXPECT_EQ(of_full[1].render_scale, "three_quarters");
    EXPECT_DOUBLE_EQ(of_full[1].share, 9 / 16.0);
    EXPECT_EQ(of_full[5].render_scale, "quarter");
    EXPECT_DOUBLE_EQ(of_full[5].share, 1 / 16.0);
    options.render_scale = "half";
    const std::vector<MotionLevel> of_half = motion_levels(options, true, true);
    ASSERT_EQ(of_half.size(), 3U);
    EXPECT_EQ(of_half[1].render_scale, "third");
    EXPECT_DOUBLE_EQ(of_half[1].share, 4 / 9.0);
    for (std::size_t i = 1; i < of_full.size(); ++i)
        EXPECT_LT(of_full[i].share, of_full[i - 1].share);
}

TEST(MotionLevels, SamplesGoBeforePixels) {
    frame::FrameOptions options;
    options.samples = 4;
    const std::vector<MotionLevel> levels = motion_levels(options, true, true);
    ASSERT_EQ(levels.size(), 7U);
    EXPECT_FALSE(levels[0].one_sample);
    EXPECT_EQ(levels[1].render_scale, "");
    for (std::size_t i = 1; i < levels.size(); ++i) {
        EXPECT_TRUE(levels[i].one_sample);
        EXPECT_LT(levels[i].share, levels[i - 1].share);
    }
    EXPECT_FALSE(motion_levels(options, false, true)[1].one_sample);
    options.aa = "tent"; // a rung that was chosen
    EXPECT_FALSE(motion_levels(options, true, true)[1].one_sample);
}

TEST(MotionLevels, WhatTheUserNamedStays) {
    EXPECT_EQ(motion_levels({}, true, false).size(), 1U);
}

} // namespace
} // namespace scanout::app
