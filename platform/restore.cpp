#include "platform/restore.h"

#include "platform/device_calls.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include <linux/kd.h>
#include <linux/vt.h>
#include <poll.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

namespace scanout::console {
namespace {

// Faults, and the timers and limits that end a program by default.
constexpr std::array kFatalSignals{SIGSEGV, SIGABRT, SIGBUS,    SIGFPE,  SIGILL, SIGSYS, SIGTRAP,
                                   SIGXCPU, SIGALRM, SIGVTALRM, SIGPROF, SIGIO,  SIGPWR};
// Likewise, and the real-time ones: where a terminal asks for it. The seat's server uses some.
constexpr std::array kOtherSignals{SIGUSR1, SIGUSR2, SIGSTKFLT};
constexpr std::size_t kSignalNumbers = 65;

// Written by the main thread, read by handlers on any thread: a flag is set after its data.
ConsoleState console_state;
TerminalState terminal_state;
std::atomic<bool> console_remembered{false}, terminal_remembered{false};
static_assert(std::atomic<bool>::is_always_lock_free);
std::array<struct sigaction, kSignalNumbers> earlier_actions; // by the signal
// A handler on its own stack also survives a stack overflow.
std::array<std::byte, std::size_t{1} << 16> handler_stack;

void on_fatal_signal(int signal, siginfo_t* info, void*) {
    ::signal(SIGTSTP, SIG_IGN); // a thread may be about to stop the process for its terminal's sake
    restore_now();
    // Restores the earlier handlers (a sanitizer, the core dump). A fault repeats by itself when
    // the handler returns; a signal that was sent is sent again.
    ::sigaction(signal, &earlier_actions[static_cast<std::size_t>(signal)], nullptr);
    const bool fault = info->si_code > 0 && info->si_code != SI_KERNEL;
    if (!fault) ::raise(signal);
}

// With a terminal that takes nothing; with one that says nothing, where the answer to a frame that
// it has not read yet comes first.
constexpr long kTakesMs = 500, kAnswersMs = 2000;

class Deadline {
public:
    explicit Deadline(long ms) : end_(now_ms() + ms) {}
    int left_ms() const { return static_cast<int>(std::max(end_ - now_ms(), 0L)); }

private:
    static long now_ms() { // steady_clock is not said to be safe in a handler
        timespec now{};
        ::clock_gettime(CLOCK_MONOTONIC, &now);
        return static_cast<long>(now.tv_sec) * 1000 + now.tv_nsec / 1'000'000;
    }
    long end_;
};

bool becomes(int fd, short event, const Deadline& deadline) {
    pollfd state{fd, event, 0};
    int ready = 0;
    do
        ready = ::poll(&state, 1, deadline.left_ms());
    while (ready < 0 && errno == EINTR && deadline.left_ms() > 0);
    return ready == 1 && (state.revents & event) != 0;
}

bool in_foreground(int fd) {
    const pid_t foreground = ::tcgetpgrp(fd);
    return foreground < 0 || foreground == ::getpgrp();
}

// The descriptor may be one that does not block. What a terminal does not take is thrown away, so
// that it takes this.
bool write_patiently(int fd, std::string_view text) {
    for (bool thrown_away = false; !text.empty();) {
        const ssize_t count = ::write(fd, text.data(), text.size());
        if (count > 0) {
            text.remove_prefix(static_cast<std::size_t>(count));
        } else if (count < 0 && errno == EAGAIN) {
            if (becomes(fd, POLLOUT, Deadline(kTakesMs))) continue;
            if (std::exchange(thrown_away, true)) return false;
            ::tcflush(fd, TCOFLUSH);
        } else if (count == 0 || errno != EINTR) {
            return false;
        }
    }
    return true;
}

// Reads up to ESC [ 0 n, or 3 n, which answer the last question and no other. Who reads in the
// background is stopped.
void wait_for_status(int fd) {
    const Deadline deadline(kAnswersMs);
    std::size_t matched = 0; // of ESC [ 0 n
    while (in_foreground(fd) && becomes(fd, POLLIN, deadline)) {
        char c = 0;
        const ssize_t count = ::read(fd, &c, 1);
        if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
        if (count <= 0) return;
        constexpr std::string_view kStatus = "\x1b[0n";
        if (c == kStatus[matched] || (matched == 2 && c == '3'))
            ++matched;
        else
            matched = c == kStatus[0] ? 1 : 0;
        if (matched == kStatus.size()) return;
    }
}

void take_over(int signal) {
    struct sigaction action {};
    action.sa_sigaction = on_fatal_signal;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
    sigemptyset(&action.sa_mask);
    ::sigaction(signal, &action, &earlier_actions[static_cast<std::size_t>(signal)]);
}

// Those that would end the program: not what is ignored, or has a use.
void take_over_others() {
    static bool installed = false;
    if (std::exchange(installed, true)) return;
    const auto take = [](int signal) {
        struct sigaction now {};
        if (::sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_DFL) take_over(signal);
    };
    for (const int signal : kOtherSignals)
        take(signal);
    for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal)
        take(signal);
}

void install_handlers() {
    static bool installed = false;
    if (std::exchange(installed, true)) return;
    stack_t stack{};
    stack.ss_sp = handler_stack.data();
    stack.ss_size = handler_stack.size();
    stack_t earlier{};
    if (::sigaltstack(nullptr, &earlier) == 0 && (earlier.ss_flags & SS_DISABLE) != 0)
        ::sigaltstack(&stack, nullptr);
    for (const int signal : kFatalSignals)
        take_over(signal);
    std::atexit(restore_now);
}

} // namespace

void restore_terminal(const TerminalState& state) {
    if (!state.farewell.empty() && write_patiently(state.fd, state.farewell) && state.answers)
        wait_for_status(state.fd);
    if (in_foreground(state.fd)) ::tcsetattr(state.fd, TCSAFLUSH, &state.modes);
    if (state.afterwards != nullptr) state.afterwards();
}

void restore_modes(const ConsoleState& state) {
    control(state.fd, KDSKBMODE, state.keyboard_mode);
    control(state.fd, KDSETMODE, KD_GRAPHICS);
    control(state.fd, KDSETMODE, KD_TEXT);
}

void restore_switching(const ConsoleState& state) {
    control(state.fd, KDSKBMODE, state.keyboard_mode);
    vt_mode automatic{};
    automatic.mode = VT_AUTO;
    control(state.fd, VT_SETMODE, &automatic);
}

void restore_console(const ConsoleState& state) {
    restore_modes(state);
    restore_switching(state);
}

void remember_console(const ConsoleState& state) {
    console_remembered = false;
    console_state = state;
    console_remembered = true;
    install_handlers();
}

void remember_terminal(const TerminalState& state) {
    terminal_remembered = false;
    terminal_state = state;
    terminal_remembered = true;
    install_handlers();
    if (state.every_signal) take_over_others();
}

void forget_console() {
    console_remembered = false;
}
void forget_terminal() {
    terminal_remembered = false;
}

void restore_now() {
    const int saved_errno = errno;
    if (console_remembered.exchange(false)) restore_console(console_state);
    if (terminal_remembered.exchange(false)) restore_terminal(terminal_state);
    errno = saved_errno;
}

} // namespace scanout::console
