// The files that the command line names: their names, and checks before any is opened. An output
// must not destroy an input or another output, and needs a folder.
#pragma once

#include "base/result.h"

#include <string>
#include <vector>

namespace scanout::app {

// The path's last part.
std::string file_name_of(const std::string& path);

// Exit::usage when an output is the same file as an input or as another output, by name or by
// inode; Exit::unreadable when an output is a folder, or its folder is not there. "-" and empty
// names are nobody's file.
Result<void> check_outputs(const std::vector<std::string>& inputs,
                           const std::vector<std::string>& outputs);

// Exit::usage when more than one output is "-".
Result<void> check_standard_output(const std::vector<std::string>& outputs);

// Exit::unreadable, with advice, when the file cannot be opened for reading.
Result<void> check_readable(const std::string& path);

} // namespace scanout::app
