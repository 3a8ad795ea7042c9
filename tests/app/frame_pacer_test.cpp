#include "app/view/frame_pacer.h"

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

using namespace std::chrono_literals;

constexpr FramePacer::Time kStart{std::chrono::hours(1)};

TEST(FramePacer, AFrameIsDueARefreshAfterTheOneBefore) {
    FramePacer pacer(50);
    EXPECT_LT(pacer.due(), kStart) << "the first at once";
    pacer.begin_frame(kStart);
    pacer.begin_frame(pacer.due());
    EXPECT_EQ(pacer.due() - pacer.last(), 20ms);
}

TEST(FramePacer, OneLateFrameDoesNotDelayTheFramesAfterIt) {
    FramePacer pacer(50);
    pacer.begin_frame(kStart);
    const FramePacer::Time due = pacer.due();
    pacer.begin_frame(due + 5ms);
    EXPECT_EQ(pacer.due(), due + 20ms);
}

TEST(FramePacer, FramesThatWereMissedAreNotMadeUpFor) {
    FramePacer pacer(50);
    pacer.begin_frame(kStart);
    pacer.begin_frame(kStart + 500ms);
    EXPECT_GE(pacer.due(), kStart + 510ms);
}

TEST(FramePacer, CountsFramesASecondButNotAcrossAPause) {
    FramePacer pacer(60);
    pacer.begin_frame(kStart);
    EXPECT_EQ(pacer.frames_per_second(), 0);
    pacer.begin_frame(kStart + 40ms);
    EXPECT_DOUBLE_EQ(pacer.frames_per_second(), 25);
    pacer.begin_frame(kStart + 2s);
    EXPECT_EQ(pacer.frames_per_second(), 0);
}

TEST(FramePacer, ADisplayThatDoesNotTellItsRateHas60Hz) {
    FramePacer pacer(0);
    pacer.begin_frame(kStart);
    pacer.begin_frame(pacer.due());
    EXPECT_NEAR(std::chrono::duration<double>(pacer.due() - pacer.last()).count(), 1 / 60.0, 1e-6);
}

} // namespace
} // namespace scanout::app
