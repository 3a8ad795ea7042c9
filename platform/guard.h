// A small process that outlives us: when we die without a chance to act (SIGKILL, out of memory,
// the whole process group killed together with libseat's built-in server), it restores the console.
#pragma once

#include "base/fd.h"
#include "platform/restore.h"

#include <sys/types.h>

namespace scanout::console {

class Guard {
public:
    // Forks; must run before any thread exists. Where no process can be made there is no guard.
    explicit Guard(const ConsoleState& state);
    ~Guard(); // tells it that all is well, and waits for its end
    Guard(const Guard&) = delete;
    Guard& operator=(const Guard&) = delete;

private:
    Fd pipe_;
    pid_t pid_ = -1;
};

} // namespace scanout::console
