// What the first frame of a process takes.
#pragma once

#include "base/result.h"
#include "bench/peers/load.h"

#include <string>
#include <vector>

namespace scanout::bench {

// Our first frame as a multiple of the next ones of the same view (their median), on one thread, by
// what it ran. The process has drawn nothing before; the scene's facts are known, as they are to
// the program when it has loaded a model.
Result<double> first_over_next(const Load& load, int width, int height);

// The same of a process of its own, this program with these words, which prints it: its renderer
// has all buffers to make, what it writes to is cleared by the system, and its code is read first.
Result<double> first_of_process(std::vector<std::string> words);

} // namespace scanout::bench
