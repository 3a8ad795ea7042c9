// Times of frames on one thread: wall time, and what of it the thread ran.
#pragma once

#include "base/stopwatch.h"
#include "measure/median.h"

#include <algorithm>
#include <ctime>
#include <vector>

namespace scanout::bench {

inline double thread_milliseconds() {
    std::timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

struct Times {
    std::vector<double> wall, cpu; // ms, one a frame

    template <class F>
    void add(F&& frame) {
        const Stopwatch watch;
        const double before = thread_milliseconds();
        frame();
        cpu.push_back(thread_milliseconds() - before);
        wall.push_back(watch.milliseconds());
    }
    double wall_median() const { return measure::median(wall); }
    double cpu_median() const { return measure::median(cpu); }
    double wall_least() const { return least(wall); }
    double cpu_least() const { return least(cpu); }

private:
    static double least(const std::vector<double>& of) {
        return of.empty() ? 0 : *std::min_element(of.begin(), of.end());
    }
};

} // namespace scanout::bench
