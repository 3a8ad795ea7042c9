// The manual page scanout(1), of the tables of commands, options and keys: man(7).
#pragma once

#include <string>

namespace scanout::app {

std::string man_page();

} // namespace scanout::app
