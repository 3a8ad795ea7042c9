#include "platform/restore.h"

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
#include <sys/ioctl.h>
#include <unistd.h>

namespace scanout::console {
namespace {

// Faults, and the timers and limits that end a program by default. Not SIGUSR1 and SIGUSR2: the
// seat's server uses them.
constexpr std::array kFatalSignals{SIGSEGV, SIGABRT, SIGBUS,    SIGFPE,  SIGILL, SIGSYS, SIGTRAP,
                                   SIGXCPU, SIGALRM, SIGVTALRM, SIGPROF, SIGIO,  SIGPWR};

// Written by the main thread, read by handlers on any thread: a flag is set after its data.
ConsoleState console_state;
TerminalState terminal_state;
std::atomic<bool> console_remembered{false}, terminal_remembered{false};
static_assert(std::atomic<bool>::is_always_lock_free);
std::array<struct sigaction, kFatalSignals.size()> earlier_actions;
// A handler on its own stack also survives a stack overflow.
std::array<std::byte, std::size_t{1} << 16> handler_stack;

void on_fatal_signal(int signal, siginfo_t* info, void*) {
    restore_now();
    // Restores the earlier handlers (a sanitizer, the core dump). A fault repeats by itself when
    // the handler returns; a signal that was sent is sent again.
    for (std::size_t i = 0; i < kFatalSignals.size(); ++i)
        if (kFatalSignals[i] == signal) ::sigaction(signal, &earlier_actions[i], nullptr);
    const bool fault = info->si_code > 0 && info->si_code != SI_KERNEL;
    if (!fault) ::raise(signal);
}

constexpr int kPatienceMs = 500; // with a terminal that takes or says nothing

bool becomes(int fd, short event) {
    pollfd state{fd, event, 0};
    return ::poll(&state, 1, kPatienceMs) == 1 && (state.revents & event) != 0;
}

// The descriptor may be one that does not block. What a terminal does not take is thrown away, so
// that it takes this.
bool write_patiently(int fd, std::string_view text) {
    for (bool thrown_away = false; !text.empty();) {
        const ssize_t count = ::write(fd, text.data(), text.size());
        if (count > 0) {
            text.remove_prefix(static_cast<std::size_t>(count));
        } else if (count < 0 && errno == EAGAIN) {
            if (becomes(fd, POLLOUT)) continue;
            if (std::exchange(thrown_away, true)) return false;
            ::tcflush(fd, TCOFLUSH);
        } else if (count == 0 || errno != EINTR) {
            return false;
        }
    }
    return true;
}

// Reads up to the end of ESC [ ? ... c, which answers the last question.
void wait_for_attributes(int fd) {
    int matched = 0; // of ESC [ ? and what follows
    while (becomes(fd, POLLIN)) {
        char c = 0;
        const ssize_t count = ::read(fd, &c, 1);
        if (count <= 0) {
            if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
            return;
        }
        constexpr std::string_view kStart = "\x1b[?";
        if (matched == 3) {
            if (c == 'c') return;
            if (c == ';' || (c >= '0' && c <= '9')) continue;
            matched = 0;
        }
        matched = c == kStart[static_cast<std::size_t>(matched)] ? matched + 1
                  : c == '\x1b'                                  ? 1
                                                                 : 0;
    }
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
    struct sigaction action {};
    action.sa_sigaction = on_fatal_signal;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
    sigemptyset(&action.sa_mask);
    for (std::size_t i = 0; i < kFatalSignals.size(); ++i)
        ::sigaction(kFatalSignals[i], &action, &earlier_actions[i]);
    std::atexit(restore_now);
}

} // namespace

void restore_terminal(const TerminalState& state) {
    if (!state.farewell.empty() && write_patiently(state.fd, state.farewell) && state.answers)
        wait_for_attributes(state.fd);
    const pid_t foreground = ::tcgetpgrp(state.fd);
    if (foreground < 0 || foreground == ::getpgrp()) ::tcsetattr(state.fd, TCSAFLUSH, &state.modes);
    if (state.afterwards != nullptr) state.afterwards();
}

void restore_modes(const ConsoleState& state) {
    ::ioctl(state.fd, KDSKBMODE, state.keyboard_mode);
    ::ioctl(state.fd, KDSETMODE, KD_GRAPHICS);
    ::ioctl(state.fd, KDSETMODE, KD_TEXT);
}

void restore_switching(const ConsoleState& state) {
    ::ioctl(state.fd, KDSKBMODE, state.keyboard_mode);
    vt_mode automatic{};
    automatic.mode = VT_AUTO;
    ::ioctl(state.fd, VT_SETMODE, &automatic);
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
