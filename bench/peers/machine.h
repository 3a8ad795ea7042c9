// What the figures were measured on, and with.
#pragma once

#include <string>

namespace scanout::bench {

std::string cpu_name();      // and how many there are
std::string compiler_name(); // of this program
double load_average();       // of the last minute: 0 on an idle machine

// The calling thread stays on one of the cores that it may run on: the first, the second, ..., the
// first again.
void stay_on_one_core(int number = 0);
void run_anywhere();

} // namespace scanout::bench
