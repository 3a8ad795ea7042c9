// What `scanout list` lists, as JSON: an array of objects each.
#pragma once

#include "app/settings.h"
#include "base/technique.h"

#include <string>
#include <vector>

namespace scanout::app {

// Is it the display that --device names? Without --device, each is.
bool is_wanted(const Settings& settings, const std::string& device);

// The cards of the axis that the second word names; all without one. In the order of techniques.h.
std::vector<const Technique*> techniques_of(const Settings& settings);

std::string displays_json(const Settings& settings);
std::string connectors_json(const Settings& settings);
std::string modes_json(const Settings& settings);
std::string techniques_json(const Settings& settings);
std::string formats_json(const Settings& settings);
std::string targets_json(const Settings& settings);
std::string keys_json(const Settings& settings);
std::string options_json(const Settings& settings);

} // namespace scanout::app
