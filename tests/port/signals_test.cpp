#include "port/signals.h"

#include <vector>

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

namespace scanout::port {
namespace {

TEST(Signals, ThatEndAProgramAreQuitEventsAndTheStopKeyIsSuspend) {
    auto signals = Signals::create();
    ASSERT_TRUE(signals);
    const auto next = [&](int signal) {
        ::kill(::getpid(), signal);
        std::vector<Event> events;
        EXPECT_TRUE(signals->dispatch(events));
        EXPECT_EQ(events.size(), 1U) << signal;
        return events.empty() ? EventKind::motion : events[0].kind;
    };
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT})
        EXPECT_EQ(next(signal), EventKind::quit) << signal;
    EXPECT_EQ(next(SIGTSTP), EventKind::suspend);
}

} // namespace
} // namespace scanout::port
