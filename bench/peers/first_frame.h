// What the first frame of a process takes.
#pragma once

#include "base/result.h"
#include "bench/peers/load.h"

#include <string>
#include <vector>

namespace scanout::bench {

// On one thread, by what it ran.
struct FirstFrame {
    double over_next; // as a multiple of the next ones of the same view (their median)
    double facts_ms;  // of the scene, which are known before it, as part of loading a model
};
// The process has drawn nothing before.
Result<FirstFrame> first_frame(const Load& load, int width, int height);

// FirstFrame::over_next of a process of its own, this program with these words, which prints it
// first: its renderer has all buffers to make, what it writes to is cleared by the system, and its
// code is read first.
Result<double> first_of_process(std::vector<std::string> words);

} // namespace scanout::bench
