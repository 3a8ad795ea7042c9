// All techniques there are, of whatever module: what `scanout list techniques` prints.
#pragma once

#include "base/technique.h"

#include <string>
#include <string_view>
#include <vector>

namespace scanout::frame {

// In the order of techniques.h.
const std::vector<const Technique*>& techniques();
// The names on an axis, each with a space before it.
std::string names_of(std::string_view axis);

} // namespace scanout::frame
