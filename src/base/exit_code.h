// The program's exit codes (docs/EXAMPLES.md, "Exit codes"). An Error carries the one that it leads
// to.
#pragma once

namespace scanout {

enum class Exit : int {
    ok = 0,
    usage = 2,      // the command line is wrong
    unreadable = 3, // a file cannot be read, or its format is not supported
    hazards = 4,    // hazards found, with --strict; a blank picture, with --fail-if-empty
    no_display = 5, // no display, or no permission to use it
    sizes_differ = 21,
    pixels_differ = 22,
    internal = 70,
};

} // namespace scanout
