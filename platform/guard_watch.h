// What the guard does once it runs: it waits for the end of the program that draws.
#pragma once

#include "platform/restore.h"

#include <sys/types.h>

namespace scanout::console {

// Of whom the console depends.
struct Watched {
    pid_t program = -1; // who draws
    pid_t server = -1;  // libseat's built-in server, a fork of the program; -1: none
};

// Waits until the program says farewell on `pipe`, or ends without; then the console is restored.
// Ends the process. Makes system calls alone: it also runs in a fork.
[[noreturn]] void watch(int pipe, const ConsoleState& console, const Watched& watched);

} // namespace scanout::console
