// What times depend on beside the picture: the machine, the program, the day.
#pragma once

#include <string>

namespace scanout::app {

std::string machine_name();     // of the processor, as it names itself
std::string today();            // year-month-day, UTC
std::string program_identity(); // version, size and time of the program's file

} // namespace scanout::app
