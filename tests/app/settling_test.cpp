#include "app/view/settling.h"

#include <gtest/gtest.h>

namespace scanout::app {
namespace {

using namespace std::chrono_literals;

class SettlingTest : public ::testing::Test {
protected:
    bool follow(int picture, std::chrono::milliseconds at, bool turning = false) {
        PictureKey key;
        key.generation = picture;
        return settling.follow(key, turning, start + at);
    }
    Settling::Time start{1h};
    Settling settling;
};

TEST_F(SettlingTest, EndsOnceThePictureHasStood) {
    EXPECT_FALSE(follow(1, 0ms));
    EXPECT_TRUE(settling.moves());
    EXPECT_FALSE(follow(2, 100ms));
    EXPECT_FALSE(follow(2, 249ms));
    EXPECT_TRUE(settling.moves());
    EXPECT_TRUE(follow(2, 250ms));
    EXPECT_FALSE(settling.moves());
    EXPECT_FALSE(follow(2, 900ms)) << "it is said once";
}

// Where the best picture is on show already, nothing wakes up when it settles.
TEST_F(SettlingTest, TheNextOneTellsThatTheLastHasEnded) {
    follow(1, 0ms);
    EXPECT_TRUE(follow(2, 5000ms));
    EXPECT_TRUE(settling.moves());
    EXPECT_TRUE(follow(2, 10000ms, true)) << "it begins to turn";
    EXPECT_TRUE(settling.moves());
}

TEST_F(SettlingTest, SlowFramesAreNoStillness) {
    follow(1, 0ms);
    for (int i = 2; i < 9; ++i) { // 400 ms each
        settling.shown(start + 400ms * (i - 1));
        EXPECT_FALSE(follow(i, 400ms * (i - 1) + 10ms)) << i;
        EXPECT_TRUE(settling.moves());
    }
    EXPECT_FALSE(follow(8, 2900ms, true));
    EXPECT_FALSE(follow(10, 5000ms, true)) << "it turns";
    EXPECT_FALSE(follow(10, 6000ms, true));
    EXPECT_TRUE(settling.moves());
    EXPECT_TRUE(follow(10, 7000ms)) << "it turns no more";
    EXPECT_FALSE(settling.moves());
}

} // namespace
} // namespace scanout::app
