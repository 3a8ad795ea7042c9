// The warnings of a file in full: wrapped, and on pages.
#pragma once

#include "app/report/explain_report.h"

#include <string>
#include <vector>

namespace scanout::app {

// On a screen of so many letters and lines; `page` from 1 on.
ScreenPage warnings_page(const std::vector<std::string>& warnings, std::size_t letters,
                         std::size_t lines, std::size_t page);

} // namespace scanout::app
