// What a session in a terminal asks, and for how long. Whole programs on a terminal:
// terminal_test.py.
#include "platform/restore.h"
#include "platform/tty/session.h"

#include <chrono>
#include <cstring>
#include <functional>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <pty.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

namespace scanout::tty {
namespace {

constexpr const char* kHangUp = "hang up";

// Runs `child` on a new terminal of 80x24 cells, which says `answer` when the attributes are asked
// for, and that it is well when that is asked; it hangs up at kHangUp. The child's exit code.
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
    const auto answers = [&](std::string_view question, std::string_view text) {
        for (std::size_t at = 0; (at = seen.find(question)) != std::string::npos;) {
            seen.erase(at, question.size());
            if (answer.empty()) continue;
            EXPECT_GT(::write(master, text.data(), text.size()), 0);
        }
    };
    for (ssize_t count = 0; (count = ::read(master, bytes, sizeof bytes)) > 0;) {
        seen.append(bytes, static_cast<std::size_t>(count));
        if (seen.find(kHangUp) != std::string::npos) break;
        answers(kAskAttributes, answer);
        answers(console::kAskStatus, "\x1b[0n");
    }
    ::close(master);
    int status = 0;
    EXPECT_EQ(::waitpid(process, &status, 0), process);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Of a child on a terminal that nobody reads; its exit code.
int on_a_terminal_that_takes_nothing(const std::function<int()>& child) {
    winsize size{200, 400, 0, 0}; // a picture of megabytes
    int master = -1;
    const pid_t process = ::forkpty(&master, nullptr, nullptr, &size);
    if (process == 0) ::_exit(child());
    int status = 0;
    EXPECT_EQ(::waitpid(process, &status, 0), process);
    ::close(master);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

image::Image noise_for(const port::DisplayInfo& info) {
    image::Image image(info.width, info.height);
    unsigned random = 1;
    for (image::Rgba8& p : image.pixels())
        p.r = p.g = static_cast<std::uint8_t>((random = random * 1664525 + 1013904223) >> 24);
    return image;
}

bool is_readable(int fd) {
    pollfd state{fd, POLLIN, 0};
    return ::poll(&state, 1, 0) == 1;
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
        if (choice.protocol != Protocol::sixel || choice.width != 640) return 2;
        return (*session)->display().ready() ? 0 : 3;
    });
    EXPECT_EQ(code, 0);
}

// Nobody could continue this process, so that it goes on at once, on its terminal anew.
TEST(Session, AFrameThatWasNotAnsweredBeforeASuspensionIsNotWaitedForBehindIt) {
    const int code = on_a_terminal("\x1b[?62c", [] {
        const auto session = Session::open(Protocol::automatic);
        if (!session) return 1;
        Display& display = (*session)->display();
        if (!display.present(noise_for(display.info()), {})) return 2;
        if (display.ready()) return 3; // its answer has not been read
        std::vector<port::Event> events;
        if (!(*session)->suspend(events)) return 4;
        while (is_readable(display.event_fd()))
            if (!display.dispatch()) return 5;
        return display.ready() && display.stale() ? 0 : 6;
    });
    EXPECT_EQ(code, 0);
}

TEST(Session, OutputThatASuspensionThrewAwayIsNotWaitedFor) {
    const int code = on_a_terminal_that_takes_nothing([] {
        const auto session = Session::open(Protocol::automatic);
        if (!session) return 1;
        Display& display = (*session)->display();
        if (!display.present(noise_for(display.info()), {})) return 2;
        if (display.ready()) return 3; // the line is full
        std::vector<port::Event> events;
        if (!(*session)->suspend(events)) return 4;
        for (int i = 0; i < 100; ++i)
            if (!display.dispatch()) return 5;
        return is_readable(display.event_fd()) ? 6 : 0; // for nothing, and again and again
    });
    EXPECT_EQ(code, 0);
}

TEST(Session, AnEndOfTheLineIsQuit) {
    const int code = on_a_terminal("\x1b[?62c", [] {
        const auto session = Session::open(Protocol::automatic);
        if (!session) return 1;
        // The signal of it is taken away: what is left is the line.
        sigset_t hang_up;
        sigemptyset(&hang_up);
        sigaddset(&hang_up, SIGHUP);
        const Fd terminal = *Fd::open("/dev/tty", O_WRONLY);
        if (::write(terminal.get(), kHangUp, std::strlen(kHangUp)) < 0) return 4;
        int signal = 0;
        ::sigwait(&hang_up, &signal);
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
