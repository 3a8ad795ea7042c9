#include "base/jobs.h"
#include "base/stopwatch.h"
#include "base/work.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

// Until the calling thread has had this much CPU time.
void burn(double cpu_ms) {
    const Work start = thread_work();
    while ((thread_work() - start).cpu_ms() < cpu_ms) {
    }
}

TEST(Work, IsTheCpuTimeOfTheCallingThreadAndNoSleep) {
    const Work start = thread_work();
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    const Work slept = thread_work() - start;
    EXPECT_LT(slept.cpu_ms(), 15);
    burn(20);
    EXPECT_GE((thread_work() - start).cpu_ms(), 20);
    if (!counts_instructions()) {
        EXPECT_EQ(slept.instructions, 0) << "nothing is made up";
    }
}

// Eight calls of 5 ms are 40 ms of work, on however many threads.
TEST(Jobs, CountTheWorkOfAllFunctionsOnAllThreads) {
    for (const int threads : {1, 2, 5}) {
        Jobs jobs(threads);
        jobs.start_counting();
        burn(3);
        jobs.for_each(8, [](int, int) { burn(5); });
        jobs.for_each(1, [](int, int) { burn(5); });
        const double cpu_ms = jobs.stop_counting().cpu_ms();
        EXPECT_GE(cpu_ms, 48) << threads;
        EXPECT_LT(cpu_ms, 55) << threads << ": waiting is no work";
        jobs.for_each(8, [](int, int) { burn(1); }); // not counted
        jobs.start_counting();
        EXPECT_LT(jobs.stop_counting().cpu_ms(), 1) << threads;
    }
}

// One function takes long while the other worker has nothing left.
TEST(Jobs, CountNoWaitingForOtherWorkers) {
    Jobs jobs(4);
    jobs.start_counting();
    jobs.for_each(2, [](int index, int) { burn(index == 0 ? 40 : 1); });
    const double cpu_ms = jobs.stop_counting().cpu_ms();
    EXPECT_GE(cpu_ms, 41);
    EXPECT_LT(cpu_ms, 46);
}

} // namespace
} // namespace scanout::test
