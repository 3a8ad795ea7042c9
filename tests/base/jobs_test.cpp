#include "base/jobs.h"
#include "base/memory.h"

#include <array>
#include <atomic>
#include <chrono>
#include <csignal>
#include <memory>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::test {
namespace {

// A little work of uneven size, so that workers come and go.
void work(int index) {
    volatile unsigned value = 1;
    for (int i = 0; i < index % 97; ++i)
        value = value * 3 + 1;
}

TEST(Jobs, RunEveryIndexOnceAndNoWorkerTwiceAtATimeWith1To16Threads) {
    for (int threads = 1; threads <= 16; ++threads) {
        Jobs jobs(threads);
        ASSERT_EQ(jobs.threads(), threads);
        for (const int count : {0, 1, 2, 3, 15, 16, 17, 1000, 20000}) {
            std::vector<std::atomic<int>> runs(static_cast<std::size_t>(count));
            std::array<std::atomic<bool>, 16> busy{};
            std::atomic<int> faults = 0;
            jobs.for_each(count, [&](int index, int worker) {
                if (index < 0 || index >= count || worker < 0 || worker >= threads) {
                    ++faults;
                    return;
                }
                std::atomic<bool>& mine = busy[static_cast<std::size_t>(worker)];
                if (mine.exchange(true)) ++faults;
                work(index);
                ++runs[static_cast<std::size_t>(index)];
                mine = false;
            });
            ASSERT_EQ(faults, 0) << threads << " threads, " << count << " indices";
            for (const std::atomic<int>& run : runs)
                ASSERT_EQ(run, 1);
        }
    }
}

TEST(Jobs, GiveAResultThatDoesNotDependOnTheNumberOfThreads) {
    std::vector<int> expected(5000);
    for (std::size_t i = 0; i < expected.size(); ++i)
        expected[i] = static_cast<int>(i * i % 1009);
    for (const int threads : {1, 2, 3, 7, 16}) {
        Jobs jobs(threads);
        std::vector<int> got(expected.size());
        jobs.for_each(static_cast<int>(got.size()), [&](int index, int) {
            got[static_cast<std::size_t>(index)] = index * index % 1009;
        });
        EXPECT_EQ(got, expected);
    }
}

// Index 0 waits for index 1 to have started: only two workers at once can end that.
bool two_indices_meet(Jobs& jobs) {
    std::array<std::atomic<bool>, 2> started{};
    std::atomic<bool> met = true;
    jobs.for_each(2, [&](int index, int) {
        started[static_cast<std::size_t>(index)] = true;
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
        while (!started[static_cast<std::size_t>(1 - index)]) {
            if (std::chrono::steady_clock::now() > end) {
                met = false;
                return;
            }
            std::this_thread::yield();
        }
    });
    return met;
}

TEST(Jobs, RunAtTheSameTime) {
    for (const int threads : {2, 3, 16}) {
        Jobs jobs(threads);
        EXPECT_TRUE(two_indices_meet(jobs)) << threads;
    }
}

TEST(Jobs, RunAtTheSameTimeBesideOthersWithFewerThreads) {
    const Jobs one(1);
    Jobs four(4);
    const Jobs two(2);
    EXPECT_TRUE(two_indices_meet(four));
}

TEST(Jobs, SeeWhatTheCallerWroteAndTheCallerSeesWhatTheyWrote) {
    Jobs jobs(4);
    std::vector<long> cells(64, 0); // plain memory: a missing barrier is a race under tsan
    for (int round = 0; round < 500; ++round) {
        jobs.for_each(64, [&](int index, int) { cells[static_cast<std::size_t>(index)] += index; });
        cells[static_cast<std::size_t>(round % 64)] += 1;
    }
    long sum = 0;
    for (const long cell : cells)
        sum += cell;
    EXPECT_EQ(sum, 500L * (63 * 64 / 2) + 500);
}

TEST(Jobs, TakeOneThreadForEachCoreByDefaultAndCanBeMoved) {
    Jobs jobs;
    EXPECT_GE(jobs.threads(), 1);
    EXPECT_EQ(jobs.threads(), std::max(1, static_cast<int>(std::thread::hardware_concurrency())));
    Jobs moved = std::move(jobs);
    std::atomic<int> runs = 0;
    moved.for_each(100, [&](int, int) { ++runs; });
    EXPECT_EQ(runs, 100);
}

TEST(Memory, CountsWhatIsTouched) {
    constexpr std::size_t kBytes = std::size_t{64} << 20;
    const std::uint64_t before = resident_bytes();
    EXPECT_GT(before, 0U);
    {
        const std::unique_ptr<char[]> block(new char[kBytes]);
        for (std::size_t i = 0; i < kBytes; i += 4096)
            *static_cast<volatile char*>(&block[i]) = 1;
        EXPECT_GT(resident_bytes(), before + kBytes / 2);
    }
    EXPECT_GT(peak_resident_bytes(), before + kBytes / 2);
}

// A signal that ends the program must find the thread that can hold it back.
TEST(Jobs, WorkersLeaveTheEndingSignalsToTheirMaker) {
    Jobs jobs(4);
    const std::thread::id maker = std::this_thread::get_id();
    std::atomic<int> seen = 0, open_to_signals = 0;
    // On a machine with other work the maker may do a round's jobs before any worker wakes.
    const auto last = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (seen < 50 && std::chrono::steady_clock::now() < last)
        jobs.for_each(400, [&](int index, int) {
            work(index);
            if (std::this_thread::get_id() == maker) return;
            sigset_t mask;
            ::pthread_sigmask(SIG_SETMASK, nullptr, &mask);
            ++seen;
            for (const int signal : {SIGINT, SIGTERM, SIGHUP})
                open_to_signals += sigismember(&mask, signal) == 0;
        });
    EXPECT_GT(seen, 0);
    EXPECT_EQ(open_to_signals, 0);
}

} // namespace
} // namespace scanout::test
