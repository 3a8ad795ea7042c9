// The terminal's modes come back on every way out of a process. A pseudo-terminal stands for the
// console's: the virtual terminal itself is tested in the guest.
#include "base/fd.h"
#include "platform/terminal.h"

#include <cstdlib>
#include <cstring>
#include <exception>
#include <functional>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

namespace scanout::console {
namespace {

struct Pty {
    Fd ours, theirs;
    termios before{};
    Pty() {
        int a = -1, b = -1;
        EXPECT_EQ(::openpty(&a, &b, nullptr, nullptr, nullptr), 0);
        ours = Fd(a);
        theirs = Fd(b);
        EXPECT_EQ(::tcgetattr(b, &before), 0);
    }
    termios now() const {
        termios mode{};
        EXPECT_EQ(::tcgetattr(theirs.get(), &mode), 0);
        return mode;
    }
    bool restored() const {
        const termios mode = now();
        return mode.c_lflag == before.c_lflag && mode.c_iflag == before.c_iflag &&
               std::memcmp(mode.c_cc, before.c_cc, sizeof mode.c_cc) == 0;
    }
};

// Opens the terminal in a child whose standard input it is, then ends the child by `end`.
// Returns wait()'s status; `seen` is whether the child saw the terminal in raw mode.
int status_of(const Pty& pty, const std::function<void(std::unique_ptr<ConsoleInput>&)>& end) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(pty.theirs.get(), STDIN_FILENO);
        auto terminal = open_terminal();
        if (!terminal) ::_exit(90);
        if ((pty.now().c_lflag & (ICANON | ECHO)) != 0) ::_exit(91);
        end(*terminal);
        ::_exit(92);
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    return status;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SANITIZER_TAKES_FAULTS 1 // it reports them and ends the process in its own way
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SANITIZER_TAKES_FAULTS 1
#endif
#endif

TEST(Restore, OnEverySignalOfAFaultAndTheProcessStillDiesOfIt) {
    for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGTRAP}) {
        const Pty pty;
        const int status = status_of(pty, [&](auto&) { ::raise(signal); });
        EXPECT_TRUE(pty.restored()) << signal;
#ifndef SANITIZER_TAKES_FAULTS
        ASSERT_TRUE(WIFSIGNALED(status)) << signal;
        EXPECT_EQ(WTERMSIG(status), signal);
#else
        EXPECT_NE(status, 0) << signal;
#endif
    }
}

#ifndef SANITIZER_TAKES_FAULTS
TEST(Restore, OnARealFaultAndOnAStackOverflow) {
    const Pty fault;
    int status = status_of(fault, [](auto&) {
        volatile int* volatile nowhere = nullptr;
        *nowhere = 1;
    });
    EXPECT_TRUE(fault.restored());
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGSEGV);
    const Pty overflow;
    status = status_of(overflow, [](auto&) {
        static const std::function<int(int)> deeper = [](int depth) {
            volatile char room[4096];
            room[0] = static_cast<char>(depth);
            return deeper(depth + 1) + room[0];
        };
        (void)deeper(0);
    });
    EXPECT_TRUE(overflow.restored());
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGSEGV);
}

#endif

TEST(Restore, OnExitOnTerminateAndOnDestruction) {
    const Pty exited;
    EXPECT_EQ(WEXITSTATUS(status_of(exited, [](auto&) { std::exit(3); })), 3);
    EXPECT_TRUE(exited.restored());
    const Pty terminated;
    const int status = status_of(terminated, [](auto&) { std::terminate(); });
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
    EXPECT_TRUE(terminated.restored());
    const Pty destroyed;
    EXPECT_EQ(WEXITSTATUS(status_of(destroyed, [](auto& terminal) { terminal.reset(); })), 92);
    EXPECT_TRUE(destroyed.restored());
}

TEST(Restore, AProcessThatIsKilledRestoresNothingSoThisTestCanFail) {
    const Pty pty;
    status_of(pty, [](auto&) { ::kill(::getpid(), SIGKILL); });
    EXPECT_FALSE(pty.restored());
}

TEST(Terminal, ReadsKeysWithoutBlockingAndAHangUpIsQuit) {
    Pty pty;
    const Fd saved_input(::dup(STDIN_FILENO));
    ::dup2(pty.theirs.get(), STDIN_FILENO);
    auto terminal = open_terminal();
    ASSERT_TRUE(terminal) << terminal.error().what;
    std::vector<port::Event> events;
    ASSERT_TRUE((*terminal)->dispatch(events));
    EXPECT_TRUE(events.empty());
    ASSERT_EQ(::write(pty.ours.get(), "q\x1b[A", 4), 4);
    ASSERT_TRUE((*terminal)->dispatch(events));
    ASSERT_EQ(events.size(), 4U);
    EXPECT_EQ(events[0].keysym, std::uint32_t{'q'});
    events.clear();
    pty.ours = Fd();
    ASSERT_TRUE((*terminal)->dispatch(events));
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].kind, port::EventKind::quit);
    EXPECT_EQ((*terminal)->event_fd(), -1);
    ::dup2(saved_input.get(), STDIN_FILENO);
}

TEST(Terminal, RefusesAnInputThatIsNone) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::setsid(); // no controlling terminal either
        const Fd nothing(::open("/dev/null", O_RDONLY));
        ::dup2(nothing.get(), STDIN_FILENO);
        const auto terminal = open_terminal();
        ::_exit(!terminal && terminal.error().exit == Exit::no_display ? 0 : 1);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
}

} // namespace
} // namespace scanout::console
