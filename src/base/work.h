// What a thread has done: its CPU time, and the instructions of the program where the machine
// counts them. Other programs on the same cores lengthen wall time, but not these. For reports
// only: nothing that is drawn depends on it.
#pragma once

#include <cstdint>

namespace scanout {

struct Work {
    std::int64_t cpu_ns = 0;
    std::int64_t instructions = 0; // in user space; 0 where they are not counted
    double cpu_ms() const { return static_cast<double>(cpu_ns) * 1e-6; }
    friend bool operator==(const Work&, const Work&) = default;
};
constexpr Work operator+(const Work& a, const Work& b) {
    return {a.cpu_ns + b.cpu_ns, a.instructions + b.instructions};
}
constexpr Work operator-(const Work& a, const Work& b) {
    return {a.cpu_ns - b.cpu_ns, a.instructions - b.instructions};
}

// Of the calling thread, from some moment on: differences count.
Work thread_work();

// Whether the kernel lets this program count instructions (perf_event_open); virtual machines often
// have no counter.
bool counts_instructions();

} // namespace scanout
