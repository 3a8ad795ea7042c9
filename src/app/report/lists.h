// What `scanout list` lists of the program itself, as JSON: an array of objects each. displays.h
// has what it lists of the machine.
#pragma once

#include "app/options/settings.h"
#include "base/technique.h"

#include <string>
#include <vector>

namespace scanout::app {

// The cards of the axis that the second word names; all without one. In the order of techniques.h.
std::vector<const Technique*> techniques_of(const Settings& settings);

std::string techniques_json(const Settings& settings);
std::string formats_json(const Settings& settings);
std::string targets_json(const Settings& settings);
std::string keys_json(const Settings& settings);
std::string options_json(const Settings& settings);
std::string renderers_json(const Settings& settings); // and their parts

} // namespace scanout::app
