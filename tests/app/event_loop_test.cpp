#include "app/view/event_loop.h"

#include <gtest/gtest.h>
#include <sys/eventfd.h>
#include <unistd.h>

namespace scanout::app {
namespace {

using namespace std::chrono_literals;

struct Loop : ::testing::Test {
    static void raise(const Fd& fd) { EXPECT_EQ(::eventfd_write(fd.get(), 1), 0); }

    Fd display{::eventfd(0, EFD_NONBLOCK)}, input{::eventfd(0, EFD_NONBLOCK)};
    EventLoop loop = EventLoop::create(display.get(), input.get()).value();
};

TEST_F(Loop, SleepsUntilTheTimeAndNotShorter) {
    const EventLoop::Time wake = std::chrono::steady_clock::now() + 50ms;
    EXPECT_FALSE(*loop.sleep(wake, -1));
    EXPECT_GE(std::chrono::steady_clock::now(), wake);
}

TEST_F(Loop, ATimeThatIsGoneWakesItAtOnce) {
    EXPECT_FALSE(*loop.sleep(EventLoop::Time(), -1));
}

// An earlier time must not end a later sleep.
TEST_F(Loop, ForgetsTheTimeOfTheSleepBefore) {
    const EventLoop::Time start = std::chrono::steady_clock::now();
    ASSERT_FALSE(*loop.sleep(start + 20ms, 0));
    EXPECT_FALSE(*loop.sleep(std::nullopt, 100));
    EXPECT_GE(std::chrono::steady_clock::now() - start, 95ms);
}

TEST_F(Loop, SaysWhetherTheInputWokeIt) {
    raise(display);
    EXPECT_FALSE(*loop.sleep(std::nullopt, -1));
    raise(input);
    EXPECT_TRUE(*loop.sleep(std::nullopt, -1));
}

TEST(EventLoop, DoesWithoutDescriptors) {
    EventLoop loop = EventLoop::create(-1, -1).value();
    EXPECT_FALSE(*loop.sleep(std::nullopt, 0));
}

TEST(EventLoop, RefusesADescriptorThatIsNone) {
    EXPECT_FALSE(EventLoop::create(1'000'000, -1));
}

} // namespace
} // namespace scanout::app
