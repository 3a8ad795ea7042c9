// Options as their users read them: in the help and in tables.
#pragma once

#include "app/options/options.h"

#include <string>
#include <string_view>

namespace scanout::app {

std::string_view title_of(Group group);

// "N", "none|back|front", or nothing for a switch.
std::string value_text(const Option& option);

// `list options`: a table in Markdown.
std::string options_markdown();

} // namespace scanout::app
