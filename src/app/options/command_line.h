// argv -> Settings, or a text to print. CLI11 splits the words; the table of options gives them
// their meaning.
#pragma once

#include "app/options/settings.h"
#include "app/options/standing_options.h"
#include "base/result.h"

#include <functional>
#include <string>
#include <vector>

namespace scanout::app {

struct CommandLine {
    Settings settings;
    std::string printout; // --help, --version: print this instead of running a command
};

// `arguments`: without the program's name. `read_standing`: gives the user's options for every run;
// called where they count. Errors: Exit::usage, one line with the nearest name.
using ReadStanding = std::function<Result<std::vector<StandingPlace>>()>;
Result<CommandLine> parse_command_line(std::vector<std::string> arguments,
                                       const ReadStanding& read_standing = nullptr);

} // namespace scanout::app
