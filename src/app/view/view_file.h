// Views kept in files: --like FILE draws what a screenshot shows, --state FILE goes on where the
// viewer was left.
#pragma once

#include "app/options/standing_options.h"
#include "base/result.h"

#include <string>

namespace scanout::app {

// The options of the view, of a PNG that holds its command line (the viewer's screenshots do), or
// of a text that write_view() wrote. Errors: Exit::unreadable where it holds none, or cannot be
// read.
Result<StandingPlace> read_view(const std::string& path);

// `options`: of view_command.h.
Result<void> write_view(const std::string& path, const std::string& options);

} // namespace scanout::app
