// What accuracy costs, as files for programs: every point that was measured, with its figures.
#pragma once

#include "app/frontier/report.h"

#include <string>

namespace scanout::app {

// One object: machine, reference, sentences, ladders, effects, points, the frontier.
std::string to_json(const FrontierReport& report);

// A line of heads, then a line for each point; fields as in RFC 4180. What was not measured is
// empty.
std::string frontier_csv(const FrontierReport& report);

// One page with everything in it: sentences, chart, tables, pictures with their heat maps and their
// worst parts. Draws the pictures once more. Fails where no PNG can be made.
Result<std::string> frontier_html(const FrontierReport& report);

} // namespace scanout::app
