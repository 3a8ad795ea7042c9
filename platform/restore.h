// The way back to a text console, from anywhere: what must be undone is kept in one place that a
// signal handler may read. Everything here that runs in a handler is async-signal-safe.
#pragma once

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

// What restore_now() undoes. Handlers for SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGSYS, SIGTRAP
// and an atexit function are installed with the first call.
void remember_console(const ConsoleState& state);
void remember_terminal(int fd, const termios& saved);
void forget_console();
void forget_terminal();

// Undoes what is remembered, once.
void restore_now();

} // namespace scanout::console
