#include "platform/restore.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include <linux/kd.h>
#include <linux/vt.h>
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
termios terminal_state;
int terminal_fd = -1;
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

void remember_terminal(int fd, const termios& saved) {
    terminal_remembered = false;
    terminal_fd = fd;
    terminal_state = saved;
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
    if (terminal_remembered.exchange(false)) ::tcsetattr(terminal_fd, TCSAFLUSH, &terminal_state);
    errno = saved_errno;
}

} // namespace scanout::console
