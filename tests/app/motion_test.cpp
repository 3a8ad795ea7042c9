#include "app/view/motion.h"

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

using namespace std::chrono_literals;

class MotionTest : public ::testing::Test {
protected:
    bool follow(int picture, std::chrono::milliseconds at, bool turning = false) {
        PictureKey key;
        key.generation = picture;
        return motion.follow(key, turning, start + at);
    }
    Motion::Time start{1h};
    Motion motion;
};

TEST_F(MotionTest, EndsOnceThePictureHasStood) {
    EXPECT_FALSE(follow(1, 0ms));
    EXPECT_TRUE(motion.moves());
    EXPECT_FALSE(follow(2, 100ms));
    EXPECT_FALSE(follow(2, 249ms));
    EXPECT_TRUE(motion.moves());
    EXPECT_TRUE(follow(2, 250ms));
    EXPECT_FALSE(motion.moves());
    EXPECT_FALSE(follow(2, 900ms)) << "it is said once";
}

// Where the best picture is on show already, nothing wakes up when it settles.
TEST_F(MotionTest, TheNextOneTellsThatTheLastHasEnded) {
    follow(1, 0ms);
    EXPECT_TRUE(follow(2, 5000ms));
    EXPECT_TRUE(motion.moves());
    EXPECT_TRUE(follow(2, 10000ms, true)) << "it begins to turn";
    EXPECT_TRUE(motion.moves());
}

TEST_F(MotionTest, SlowFramesAreNoStillness) {
    follow(1, 0ms);
    for (int i = 2; i < 9; ++i) { // 400 ms each
        motion.shown(start + 400ms * (i - 1));
        EXPECT_FALSE(follow(i, 400ms * (i - 1) + 10ms)) << i;
        EXPECT_TRUE(motion.moves());
    }
    EXPECT_FALSE(follow(8, 2900ms, true));
    EXPECT_FALSE(follow(10, 5000ms, true)) << "it turns";
    EXPECT_FALSE(follow(10, 6000ms, true));
    EXPECT_TRUE(motion.moves());
    EXPECT_TRUE(follow(10, 7000ms)) << "it turns no more";
    EXPECT_FALSE(motion.moves());
}

} // namespace
} // namespace scanout::app
