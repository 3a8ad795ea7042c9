#include "base/jobs.h"

#include "base/check.h"

#include <algorithm>
#include <csignal>
#include <thread>
#include <vector>

#if SCANOUT_JOBS_STD_THREAD
#include <atomic>
#include <condition_variable>
#include <mutex>
#else
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/partitioner.h>
#include <oneapi/tbb/task_arena.h>
#endif

namespace scanout {

static int resolve_threads(int threads) {
    return threads > 0 ? threads
                       : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// While this lives, signals that end a program are held back in the calling thread. Workers that
// are made meanwhile inherit that, so a signal finds the thread that may hold it back at will, as
// whoever writes a file does.
class EndingSignalsHeld {
public:
    EndingSignalsHeld() {
        sigset_t ending;
        sigemptyset(&ending);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP})
            sigaddset(&ending, signal);
        ::pthread_sigmask(SIG_BLOCK, &ending, &before_);
    }
    ~EndingSignalsHeld() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    EndingSignalsHeld(const EndingSignalsHeld&) = delete;
    EndingSignalsHeld& operator=(const EndingSignalsHeld&) = delete;

private:
    sigset_t before_{};
};

#if SCANOUT_JOBS_STD_THREAD

struct Jobs::Pool {
    explicit Pool(int threads) {
        const EndingSignalsHeld held;
        for (int worker = 1; worker < threads; ++worker)
            threads_.emplace_back([this, worker] { work(worker); });
    }
    ~Pool() {
        {
            const std::lock_guard lock(mutex_);
            stop_ = true;
        }
        wake_.notify_all();
        for (std::thread& t : threads_)
            t.join();
    }
    void run(int count, Thunk thunk, void* function) {
        {
            const std::lock_guard lock(mutex_);
            count_ = count;
            thunk_ = thunk;
            function_ = function;
            next_ = 0;
            busy_ = static_cast<int>(threads_.size());
            ++generation_;
        }
        wake_.notify_all();
        drain(0);
        std::unique_lock lock(mutex_);
        done_.wait(lock, [&] { return busy_ == 0; });
    }
    int threads() const { return static_cast<int>(threads_.size()) + 1; }

private:
    void drain(int worker) {
        for (int i = next_++; i < count_; i = next_++)
            thunk_(function_, i, worker);
    }
    void work(int worker) {
        unsigned seen = 0;
        std::unique_lock lock(mutex_);
        while (true) {
            wake_.wait(lock, [&] { return stop_ || generation_ != seen; });
            if (stop_) return;
            seen = generation_;
            lock.unlock();
            drain(worker);
            lock.lock();
            if (--busy_ == 0) done_.notify_one();
        }
    }
    std::mutex mutex_;
    std::condition_variable wake_, done_;
    std::vector<std::thread> threads_;
    std::atomic<int> next_{0};
    int count_ = 0, busy_ = 0;
    unsigned generation_ = 0;
    bool stop_ = false;
    Thunk thunk_ = nullptr;
    void* function_ = nullptr;
};

#else

namespace tbb = oneapi::tbb;

// Lets an arena have more workers than the machine has cores: tests run 16. One limit for all,
// since oneTBB obeys the smallest one alive: a Jobs(1) would make every other serial. Before any
// arena.
static int with_raised_limit(int threads) {
    static const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 256);
    return threads;
}

struct Jobs::Pool {
    explicit Pool(int threads) : arena(with_raised_limit(threads)) {}
    void run(int count, Thunk thunk, void* function) {
        if (threads() == 1 || count <= 1) {
            for (int i = 0; i < count; ++i)
                thunk(function, i, 0);
            return;
        }
        const EndingSignalsHeld held; // oneTBB makes its workers when there is work
        arena.execute([&] {
            tbb::parallel_for(
                0, count,
                [&](int i) { thunk(function, i, tbb::this_task_arena::current_thread_index()); },
                tbb::simple_partitioner());
        });
    }
    int threads() const { return arena.max_concurrency(); }
    tbb::task_arena arena;
};

#endif

struct Jobs::Count {
    // A cache line each: workers write theirs at the same time.
    struct alignas(64) OfWorker {
        Work work;
    };
    Work start;                      // of the calling thread
    Work in_for_each;                // of the calling thread, its functions and its waiting
    std::vector<OfWorker> functions; // by worker
};

void Jobs::start_counting() {
    count_ = std::make_unique<Count>();
    count_->functions.resize(static_cast<std::size_t>(threads()));
    count_->start = thread_work();
}

Work Jobs::stop_counting() {
    Work work = thread_work() - count_->start - count_->in_for_each;
    for (const Count::OfWorker& of : count_->functions)
        work = work + of.work;
    count_.reset();
    return work;
}

void Jobs::run(int count, Thunk thunk, void* function) {
    if (count_ == nullptr) {
        pool_->run(count, thunk, function);
        return;
    }
    struct Counted {
        Thunk thunk;
        void* function;
        Count& count;
    } counted{thunk, function, *count_};
    const Work before = thread_work();
    pool_->run(
        count,
        [](void* f, int index, int worker) {
            const Counted& c = *static_cast<Counted*>(f);
            const Work start = thread_work();
            c.thunk(c.function, index, worker);
            Work& sum = c.count.functions[static_cast<std::size_t>(worker)].work;
            sum = sum + (thread_work() - start);
        },
        &counted);
    count_->in_for_each = count_->in_for_each + (thread_work() - before);
}

Jobs::Jobs(int threads) : pool_(std::make_unique<Pool>(resolve_threads(threads))) {}
Jobs::~Jobs() = default;
Jobs::Jobs(Jobs&&) noexcept = default;
Jobs& Jobs::operator=(Jobs&&) noexcept = default;
int Jobs::threads() const {
    return pool_->threads();
}

} // namespace scanout
