// A small process that outlives us: when we die without a chance to act (SIGKILL, out of memory,
// all processes of our name killed together), it restores the console. It is the program
// console-guard where that stands beside ours or in libexec, else a fork.
#pragma once

#include "base/fd.h"
#include "platform/guard_watch.h"

#include <sys/types.h>

namespace scanout::console {

class Guard {
public:
    // Must run before any thread exists. Where no process can be made there is no guard.
    // `server`: libseat's built-in one, or -1.
    explicit Guard(const ConsoleState& state, pid_t server = -1);
    ~Guard(); // tells it that all is well, and waits for its end
    Guard(const Guard&) = delete;
    Guard& operator=(const Guard&) = delete;

private:
    Fd pipe_;
    pid_t pid_ = -1;
};

} // namespace scanout::console
