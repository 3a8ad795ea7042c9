// The way back to a text console, from anywhere: what must be undone is kept in one place that a
// signal handler may read. Everything here that runs in a handler is async-signal-safe.
#pragma once

#include <string_view>

#include <termios.h>

namespace scanout::console {

// What a console must be put back to.
struct ConsoleState {
    int fd = -1;           // the VT, /dev/ttyN
    int keyboard_mode = 0; // KDGKBMODE's answer
};

// Keyboard mode and text mode, in the order that also revives a screen which the kernel believes to
// be in text mode but has not redrawn: GRAPHICS, then TEXT.
void restore_modes(const ConsoleState& state);
// Keyboard mode, and switching without asking us: a console that shows text stays as it is.
void restore_switching(const ConsoleState& state);
// All of it.
void restore_console(const ConsoleState& state);

// What a terminal must be put back to. All of it is there until it is forgotten.
struct TerminalState {
    int fd = -1;
    termios modes{};
    std::string_view farewell = {}; // written before; with answers, its end is kAskStatus
    bool answers = false;           // to be waited for: no answer reaches the shell as a key
    bool every_signal = false;      // restores it, also those that others have a use for
    void (*afterwards)() = nullptr; // may run in a handler
};
// Device status report (DSR): nothing else in a session asks it, so that its answer is the last one
// of all, whatever was not answered before.
inline constexpr const char* kAskStatus = "\x1b[5n";
// Restores the modes, but for those of a terminal that belongs to another job now.
void restore_terminal(const TerminalState& state);

// What restore_now() undoes. Handlers for SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGTRAP
// and an atexit function are installed with the first call; for SIGUSR1, SIGUSR2, SIGSTKFLT and the
// real-time signals with the first terminal that wants it.
void remember_console(const ConsoleState& state);
void remember_terminal(const TerminalState& state);
void forget_console();
void forget_terminal();

// Undoes what is remembered, once.
void restore_now();

} // namespace scanout::console
