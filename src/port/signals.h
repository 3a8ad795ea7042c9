// The signals that end or suspend a program, as input: SIGINT, SIGTERM, SIGHUP and SIGQUIT arrive
// as EventKind::quit, SIGTSTP as EventKind::suspend, through a signalfd and never in the middle of
// a frame.
#pragma once

#include "base/fd.h"
#include "port/input.h"

#include <string>
#include <vector>

namespace scanout::port {

class Signals final : public Input {
public:
    // Blocks the signals in the calling thread; threads made afterwards inherit that, so create it
    // before any thread.
    static Result<Signals> create();

    Signals() = default;
    int event_fd() const override { return fd_.get(); }
    Result<void> dispatch(std::vector<Event>& events) override;
    std::string description() const override { return "signals"; }

private:
    explicit Signals(Fd fd) : fd_(std::move(fd)) {}
    Fd fd_;
};

} // namespace scanout::port
