// No output may destroy an input or another output: said before anything is opened.
#pragma once

#include "base/result.h"

#include <string>
#include <vector>

namespace scanout::app {

// Exit::usage when an output is the same file as an input or as another output, by name or by
// inode.
// "-" and empty names are nobody's file.
Result<void> keep_apart(const std::vector<std::string>& inputs,
                        const std::vector<std::string>& outputs);

} // namespace scanout::app
