#include "app/view/event_loop.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <span>

#include <sys/epoll.h>
#include <sys/timerfd.h>
#include <unistd.h>

namespace scanout::app {
namespace {

Result<void> watch(const Fd& epoll, int fd) {
    if (fd < 0) return {};
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.fd = fd;
    if (::epoll_ctl(epoll.get(), EPOLL_CTL_ADD, fd, &event) != 0)
        return fail(Exit::internal, "epoll_ctl: {}", std::strerror(errno));
    return {};
}

} // namespace

Result<EventLoop> EventLoop::create(int display, int input, int files) {
    Fd epoll(::epoll_create1(EPOLL_CLOEXEC));
    if (!epoll.valid()) return fail(Exit::internal, "epoll: {}", std::strerror(errno));
    Fd timer(::timerfd_create(CLOCK_MONOTONIC, TFD_CLOEXEC | TFD_NONBLOCK));
    if (!timer.valid()) return fail(Exit::internal, "timerfd: {}", std::strerror(errno));
    for (const int fd : {timer.get(), display, input, files})
        TRY_VOID(watch(epoll, fd));
    return EventLoop(std::move(epoll), std::move(timer), input);
}

void EventLoop::set_timer(std::optional<Time> wake) {
    itimerspec spec{};
    if (wake) {
        const auto since_boot = std::max<std::int64_t>(
            std::chrono::nanoseconds(wake->time_since_epoch()).count(), 1); // 0 would disarm it
        spec.it_value.tv_sec = since_boot / 1'000'000'000;
        spec.it_value.tv_nsec = since_boot % 1'000'000'000;
    }
    ::timerfd_settime(timer_.get(), TFD_TIMER_ABSTIME, &spec, nullptr);
}

Result<bool> EventLoop::sleep(std::optional<Time> wake, int patience) {
    set_timer(wake);
    std::array<epoll_event, 4> events{};
    const int count =
        ::epoll_wait(epoll_.get(), events.data(), static_cast<int>(events.size()), patience);
    if (count < 0 && errno != EINTR)
        return fail(Exit::internal, "epoll_wait: {}", std::strerror(errno));
    bool input = false;
    for (const epoll_event& event :
         std::span(events).first(static_cast<std::size_t>(std::max(count, 0)))) {
        if (event.data.fd == timer_.get()) {
            std::uint64_t expirations = 0;
            [[maybe_unused]] const ssize_t n =
                ::read(timer_.get(), &expirations, sizeof expirations);
        } else if (event.data.fd == input_) {
            input = true;
        }
    }
    return input;
}

} // namespace scanout::app
