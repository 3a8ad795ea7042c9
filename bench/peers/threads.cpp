#include "bench/peers/threads.h"

#include "bench/peers/clock.h"
#include "bench/peers/ours.h"

#include <atomic>

namespace scanout::bench {
namespace {

// About 5 ms of dependent integer operations, which no other core can slow down by memory.
void compute(std::uint64_t seed, std::atomic<std::uint64_t>& sink) {
    std::uint64_t x = seed;
    for (int i = 0; i < 4000000; ++i)
        x = x * 6364136223846793005U + 1442695040888963407U;
    sink ^= x;
}

constexpr int kTurns = 3;

} // namespace

Result<ThreadsResult> measure_threads(const Load& load, const scene::Scene& scene, Jobs& two,
                                      int width, int height, int rounds) {
    Jobs one(1);
    Ours with_one(one, scene, load, width, height), with_two(two, scene, load, width, height);
    std::atomic<std::uint64_t> sink{0};
    Times ours_one, ours_two, compute_one, compute_two;
    ThreadsResult result;
    for (int round = 0; round < kTurns * rounds; ++round) {
        if (round % rounds == 0 && result.judged()) break;
        TRY(const scene::View view, view_of(load, scene, 0, 1, width, height));
        TRY_VOID(with_one.draw(view)); // its data is in the caches then, as the other's will be
        ours_one.add([&] { return with_one.draw(view).has_value(); });
        TRY_VOID(with_two.draw(view));
        ours_two.add([&] { return with_two.draw(view).has_value(); });
        // Each of two halves of the work, one after the other and at once.
        const auto halves = [&](Jobs& jobs) {
            jobs.for_each(
                2, [&](int index, int) { compute(static_cast<std::uint64_t>(index), sink); });
        };
        compute_one.add([&] { halves(one); });
        compute_two.add([&] { halves(two); });
        result = {ours_one.wall_least() / ours_two.wall_least(),
                  compute_one.wall_least() / compute_two.wall_least()};
    }
    return result;
}

} // namespace scanout::bench
