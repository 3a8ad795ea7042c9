#include "base/work.h"

#include "base/fd.h"

#include <ctime>

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace scanout {
namespace {

// Counts the calling thread's instructions in user space, from now on. Invalid where there is no
// counter, or the program may not read it.
Fd open_counter() {
    perf_event_attr wanted{};
    wanted.size = sizeof(wanted);
    wanted.type = PERF_TYPE_HARDWARE;
    wanted.config = PERF_COUNT_HW_INSTRUCTIONS;
    wanted.exclude_kernel = 1;
    wanted.exclude_hv = 1;
    constexpr int kThisThread = 0, kAnyCpu = -1, kNoGroup = -1;
    return Fd(static_cast<int>(::syscall(SYS_perf_event_open, &wanted, kThisThread, kAnyCpu,
                                         kNoGroup, PERF_FLAG_FD_CLOEXEC)));
}

std::int64_t thread_instructions() {
    thread_local const Fd counter = open_counter();
    std::int64_t count = 0;
    if (!counter.valid() || ::read(counter.get(), &count, sizeof(count)) != sizeof(count)) return 0;
    return count;
}

} // namespace

bool counts_instructions() {
    static const bool counted = thread_instructions() > 0;
    return counted;
}

Work thread_work() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return {std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec,
            counts_instructions() ? thread_instructions() : 0};
}

} // namespace scanout
