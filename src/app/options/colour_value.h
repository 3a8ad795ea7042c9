// One colour in any model, as text: "hsv:30,1,1", "#ff8000" or a name.
#pragma once

#include "base/result.h"
#include "math/vec.h"

#include <string>
#include <string_view>
#include <vector>

namespace scanout::app {

// As red, green and blue of what is shown, codes / 255; beyond [0, 1] outside of sRGB. Exit::usage
// for what is no colour, and for a component beyond what its model has.
Result<DVec3> parse_colour_value(std::string_view text);

// A line a model, which parse_colour_value reads again; first the code, with a word where it is
// only the nearest one.
std::vector<std::string> colour_lines(const DVec3& asked);

} // namespace scanout::app
