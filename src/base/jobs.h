// The seam to threads: for_each runs a function once for every index, on all workers. oneTBB behind
// it, or a small std::thread pool under ThreadSanitizer (the packaged oneTBB reports false races).
#pragma once

#include "base/float_environment.h"
#include "base/work.h"

#include <memory>
#include <type_traits>

namespace scanout {

class Jobs {
public:
    // threads: how many run at once, the caller included; 0 = one for each core.
    explicit Jobs(int threads = 0);
    ~Jobs();
    Jobs(Jobs&&) noexcept;
    Jobs& operator=(Jobs&&) noexcept;

    int threads() const;

    // Calls function(index, worker) for every index in [0, count), in no particular order;
    // worker is in [0, threads()) and no two calls with the same worker run at once. Not reentrant.
    // Results must not depend on the order or on which worker ran an index. Arithmetic is plain
    // while it runs (base/float_environment.h).
    template <class Function>
    void for_each(int count, Function&& function) {
        using F = std::remove_reference_t<Function>;
        run(
            count,
            [](void* f, int index, int worker) {
                const FloatEnvironment plain;
                (*static_cast<F*>(f))(index, worker);
            },
            const_cast<void*>(static_cast<const void*>(&function)));
    }

    // Between the two, counts the work of the calling thread and of all functions that for_each
    // calls, whatever thread runs them. Waiting for other workers is no work: while they wait they
    // spin, for longer on a busy machine. A call of a function costs two system calls more.
    void start_counting();
    Work stop_counting();

private:
    using Thunk = void (*)(void* function, int index, int worker);
    void run(int count, Thunk thunk, void* function);
    struct Pool;
    struct Count;
    std::unique_ptr<Pool> pool_;
    std::unique_ptr<Count> count_; // while work is counted
};

} // namespace scanout
