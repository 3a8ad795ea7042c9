// The mouse as terminals report it in SGR form (xterm's modes 1006 and 1016) -> events.
#pragma once

#include "port/input.h"

#include <string_view>
#include <vector>

namespace scanout::tty {

// Appends the events of a sequence such as "<0;12;5M" (after ESC [). `width`, `height`: what the
// picture measures in the reports' unit, cells or pixels; `centre`: from the unit's edge to the
// place that is meant. None of what is no report.
void add_mouse(std::string_view sequence, double width, double height, double centre,
               std::vector<port::Event>& events);

} // namespace scanout::tty
