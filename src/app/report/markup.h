// What stands inside HTML and SVG: text whose special characters are named.
#pragma once

#include <string>
#include <string_view>

namespace scanout::app {

// & < > " are named, control characters and broken UTF-8 are escaped as in message.h.
std::string as_markup(std::string_view text);

} // namespace scanout::app
