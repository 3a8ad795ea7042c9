// What a session in a terminal asks, and for how long. Whole programs on a terminal:
// terminal_test.py.
#include "platform/tty/session.h"

#include <chrono>
#include <functional>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace scanout::tty {
namespace {

// Runs `child` on a new terminal of 80x24 cells, which says `answer` when the attributes are asked
// for; the child's exit code.
int on_a_terminal(std::string_view answer, const std::function<int()>& child) {
    winsize size{24, 80, 0, 0};
    int master = -1;
    const pid_t process = ::forkpty(&master, nullptr, nullptr, &size);
    if (process == 0) {
        ::unsetenv("TMUX");
        ::setenv("TERM", "xterm", 1);
        ::_exit(child());
    }
    std::string seen;
    char bytes[4096];
    for (ssize_t count = 0; (count = ::read(master, bytes, sizeof bytes)) > 0;) {
        seen.append(bytes, static_cast<std::size_t>(count));
        for (std::size_t at = 0; (at = seen.find(kAskAttributes)) != std::string::npos;) {
            seen.erase(0, at + 3);
            if (answer.empty()) continue;
            EXPECT_GT(::write(master, answer.data(), answer.size()), 0);
        }
    }
    int status = 0;
    EXPECT_EQ(::waitpid(process, &status, 0), process);
    ::close(master);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Session, AMuteTerminalIsAskedFor200MillisecondsAndNoLonger) {
    const int code = on_a_terminal("", [] {
        using Clock = std::chrono::steady_clock;
        const Clock::time_point start = Clock::now();
        const auto session = Session::open(Protocol::automatic);
        const auto took = Clock::now() - start;
        if (!session) return 1;
        if ((*session)->display().choice().protocol != Protocol::blocks) return 2;
        if (took < std::chrono::milliseconds(200)) return 3;
        return took < std::chrono::seconds(5) ? 0 : 4; // on a busy machine
    });
    EXPECT_EQ(code, 0);
}

TEST(Session, OneThatAnswersIsNotWaitedFor) {
    const int code = on_a_terminal("\x1b[6;16;8t\x1b[?62;4c", [] {
        const auto session = Session::open(Protocol::automatic);
        if (!session) return 1;
        const Choice& choice = (*session)->display().choice();
        if (choice.protocol != Protocol::sixel || choice.width() != 640) return 2;
        return (*session)->display().ready() ? 0 : 3;
    });
    EXPECT_EQ(code, 0);
}

TEST(Session, AnEndOfTheLineIsQuit) {
    const int code = on_a_terminal("\x1b[?62c", [] {
        const auto session = Session::open(Protocol::automatic);
        if (!session) return 1;
        ::kill(::getpid(), SIGHUP);
        std::vector<port::Event> events;
        if (!(*session)->dispatch(events)) return 2;
        for (const port::Event& event : events)
            if (event.kind == port::EventKind::quit) return 0;
        return 3;
    });
    EXPECT_EQ(code, 0);
}

} // namespace
} // namespace scanout::tty
