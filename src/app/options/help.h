// --help: examples first, then the options of a command from the table.
#pragma once

#include "app/options/options.h"
#include "app/options/settings.h"

#include <string>
#include <string_view>

namespace scanout::app {

std::string help_overview();
// What the command does, and examples: plain text in lines.
std::string_view introduction(Command command);

// The options that most runs need.
std::string help_for(Command command);
// All options; where one takes a technique by name, the names.
std::string full_help_for(Command command);

// What an option does, its default, and the names of techniques that it takes.
std::string help_of(const Option& option);

} // namespace scanout::app
