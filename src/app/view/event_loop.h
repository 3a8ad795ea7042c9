// Sleeps until a display or an input can be read, or until a given time. Sets no timer without a
// time to wake up: an idle viewer costs nothing.
#pragma once

#include "base/fd.h"
#include "base/result.h"

#include <chrono>
#include <optional>

namespace scanout::app {

class EventLoop {
public:
    using Time = std::chrono::steady_clock::time_point;

    // Descriptors below 0 are never readable. `files`: wakes up, as a display does.
    static Result<EventLoop> create(int display, int input, int files = -1);

    // Sleeps until `wake`, but no longer than `patience` milliseconds (-1: without end, 0: not at
    // all). True when the input can be read.
    Result<bool> sleep(std::optional<Time> wake, int patience);

private:
    EventLoop(Fd epoll, Fd timer, int input)
        : epoll_(std::move(epoll)), timer_(std::move(timer)), input_(input) {}
    void set_timer(std::optional<Time> wake);

    Fd epoll_, timer_;
    int input_;
};

} // namespace scanout::app
