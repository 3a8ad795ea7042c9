// What `scanout info` says of a model: lines for people, JSON for scripts.
#pragma once

#include "app/report/model_info.h"

#include <string>
#include <vector>

namespace scanout::app {

std::vector<std::string> info_lines(const ModelInfo& info);
std::string info_json(const ModelInfo& info);

} // namespace scanout::app
