// The models that the command line names, where it may name folders of them.
#pragma once

#include "base/result.h"

#include <string>
#include <vector>

namespace scanout::app {

// Folders become the models in them, by name; their own folders are left out. Exit::unreadable for
// a folder without any.
Result<std::vector<std::string>> models_of(const std::vector<std::string>& arguments);

} // namespace scanout::app
