// What the program says while it draws on the terminal: kept, and written when the text is back.
#pragma once

namespace scanout::tty {

// Standard output and standard error go to a file in memory, each where it is a terminal.
void hold_output();
// They go to the terminal again, with what was held. May run in a signal handler.
void release_output();

} // namespace scanout::tty
