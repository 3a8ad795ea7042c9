#include "bench/peers/threads.h"

#include "bench/peers/clock.h"
#include "bench/peers/machine.h"
#include "bench/peers/ours.h"

#include <atomic>
#include <numeric>

namespace scanout::bench {
namespace {

// A tenth of a millisecond of sums in many chains at once: no memory slows them down, and other
// work on the same core slows them as it slows us.
void compute(std::uint32_t seed, std::atomic<std::uint32_t>& sink) {
    constexpr int kChains = 32, kSteps = 10000;
    std::uint32_t x[kChains];
    for (int c = 0; c < kChains; ++c)
        x[c] = seed + static_cast<std::uint32_t>(c);
    for (int i = 0; i < kSteps; ++i)
        for (std::uint32_t& chain : x)
            chain = chain * 1664525U + 1013904223U;
    sink ^= std::accumulate(std::begin(x), std::end(x), 0U);
}
constexpr int kPieces = 48; // whichever core is free takes the next, as of a frame's tiles

constexpr int kTurns = 3;

// What a core takes that is as fast as the two are in the mean.
double on_mean_core(const Times (&on_core)[2]) {
    return 2 / (1 / on_core[0].wall_least() + 1 / on_core[1].wall_least());
}

} // namespace

Result<ThreadsResult> measure_threads(const Load& load, const scene::Scene& scene, Jobs& two,
                                      int width, int height, int rounds) {
    Jobs one(1);
    Ours with_one(one, scene, load, width, height), with_two(two, scene, load, width, height);
    std::atomic<std::uint32_t> sink{0};
    Times ours_one[2], compute_one[2], ours_two, compute_two;
    ThreadsResult result;
    for (int round = 0; round < kTurns * rounds; ++round) {
        if (round % rounds == 0 && result.judged()) break;
        TRY(const scene::View view, view_of(load, scene, 0, 1, width, height));
        const auto compute_with = [&](Jobs& jobs) {
            jobs.for_each(
                kPieces, [&](int index, int) { compute(static_cast<std::uint32_t>(index), sink); });
        };
        // One thread takes turns between two cores: others' work slows one more than the other,
        // and two threads have both.
        const int core = round % 2;
        stay_on_one_core(core);
        TRY_VOID(with_one.draw(view)); // its data is in the caches then, as the other's will be
        ours_one[core].add([&] { return with_one.draw(view).has_value(); });
        compute_one[core].add([&] { compute_with(one); });
        run_anywhere();
        TRY_VOID(with_two.draw(view));
        ours_two.add([&] { return with_two.draw(view).has_value(); });
        compute_two.add([&] { compute_with(two); });
        if (round == 0) continue;
        result = {on_mean_core(ours_one) / ours_two.wall_least(),
                  on_mean_core(compute_one) / compute_two.wall_least()};
    }
    return result;
}

} // namespace scanout::bench
