#include "platform/guard.h"

#include <cerrno>

#include <fcntl.h>
#include <linux/kd.h>
#include <poll.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace scanout::console {
namespace {

// The main loop of the guard process, a fork: it may only make system calls.
[[noreturn]] void watch(int pipe, const ConsoleState& state) {
    sigset_t all;
    sigfillset(&all);
    ::sigprocmask(SIG_BLOCK, &all, nullptr);
    ::setpgid(0, 0); // a signal to our process group does not reach it
    ::prctl(PR_SET_NAME, "scanout-guard");
    // Keeps only these two descriptors: an open pipe would never end, an open display would stay
    // taken.
    const int high_pipe = ::fcntl(pipe, F_DUPFD, 10), high_tty = ::fcntl(state.fd, F_DUPFD, 10);
    if (::dup2(high_pipe, 0) < 0 || ::dup2(high_tty, 1) < 0) ::_exit(1);
    ::close_range(2, ~0U, 0);
    char farewell = 0;
    ssize_t count = -1;
    do
        count = ::read(0, &farewell, 1);
    while (count < 0 && errno == EINTR);
    if (count == 1) ::_exit(0);
    // libseat's server restores by itself when it lives; give it the time.
    for (int mode = KD_GRAPHICS, tries = 0; tries < 8 && mode == KD_GRAPHICS; ++tries) {
        ::poll(nullptr, 0, 10);
        if (::ioctl(1, KDGETMODE, &mode) != 0) ::_exit(0);
        if (mode == KD_TEXT) ::_exit(0);
    }
    restore_console({1, state.keyboard_mode});
    ::_exit(0);
}

} // namespace

Guard::Guard(const ConsoleState& state) {
    int ends[2] = {-1, -1};
    if (::pipe2(ends, O_CLOEXEC) != 0) return;
    Fd read_end(ends[0]);
    pipe_ = Fd(ends[1]);
    pid_ = ::fork();
    if (pid_ == 0) watch(read_end.get(), state);
}

Guard::~Guard() {
    if (pid_ <= 0) return;
    const char farewell = 1;
    [[maybe_unused]] const ssize_t written = ::write(pipe_.get(), &farewell, 1);
    while (::waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
    }
}

} // namespace scanout::console
