#include "platform/guard_watch.h"

#include "platform/device_calls.h"

#include <cerrno>

#include <linux/kd.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace scanout::console {
namespace {

// libseat's server restores the console, too, when its client is gone: it has the first try.
constexpr int kSoonMs = 50, kLateMs = 10'000;

bool shows_text(int console) {
    int mode = KD_GRAPHICS;
    return control(console, KDGETMODE, &mode) == 0 && mode == KD_TEXT;
}

// -1 where there is no such process, or the kernel is older than 5.3: then the pipe tells.
int pidfd_of(pid_t process) {
    return process > 0 ? static_cast<int>(::syscall(SYS_pidfd_open, process, 0)) : -1;
}

// Waits for the farewell; false: the program has ended without.
bool says_farewell(int pipe, int program) {
    for (;;) {
        pollfd ends[2] = {{pipe, POLLIN, 0},
                          {program, POLLIN, 0}}; // a descriptor of -1 is left out
        if (::poll(ends, 2, -1) < 0) continue;   // interrupted
        char farewell = 0;
        if (ends[0].revents != 0) {
            const ssize_t count = ::read(pipe, &farewell, 1);
            if (count < 0 && errno == EINTR) continue;
            return count == 1;
        }
        if (ends[1].revents != 0) return false;
    }
}

} // namespace

void watch(int pipe, const ConsoleState& console, const Watched& watched) {
    sigset_t all;
    sigfillset(&all);
    ::sigprocmask(SIG_BLOCK, &all, nullptr);
    ::prctl(PR_SET_NAME, "console-guard"); // `killall scanout` does not mean the guard
    const int program = pidfd_of(watched.program), server = pidfd_of(watched.server);
    if (says_farewell(pipe, program)) ::_exit(0);
    pollfd end{server, POLLIN, 0};
    const bool serves = server >= 0 && ::poll(&end, 1, kSoonMs) == 0;
    if (server < 0 || !shows_text(console.fd)) restore_console(console);
    // It leaves the switching to itself, and ends: the last word is ours.
    if (serves) ::poll(&end, 1, kLateMs);
    restore_switching(console);
    ::_exit(0);
}

} // namespace scanout::console
