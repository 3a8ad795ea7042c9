// argv -> Settings, or a text to print. CLI11 splits the words; the table of options gives them
// their meaning.
#pragma once

#include "app/settings.h"
#include "base/result.h"

#include <string>
#include <vector>

namespace scanout::app {

struct CommandLine {
    Settings settings;
    std::string printout; // --help, --version: print this instead of running a command
};

// `arguments`: without the program's name. Errors: Exit::usage, one line with the nearest name.
Result<CommandLine> parse_command_line(std::vector<std::string> arguments);

} // namespace scanout::app
