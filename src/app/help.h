// --help: examples first, then every option of a command from the table.
#pragma once

#include "app/settings.h"

#include <string>

namespace scanout::app {

std::string help_overview();
std::string help_for(Command command);

} // namespace scanout::app
