// What the figures were measured on, and with.
#pragma once

#include <string>

namespace scanout::bench {

std::string cpu_name();      // and how many there are
std::string compiler_name(); // of this program
double load_average();       // of the last minute: 0 on an idle machine

// That the process may run on.
int cores();
// The calling thread stays on one of them: the first, the second, ..., the first again.
void stay_on_one_core(int number);
void run_anywhere();

} // namespace scanout::bench
