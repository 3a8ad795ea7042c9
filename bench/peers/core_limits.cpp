#include "bench/peers/core_limits.h"

#include "bench/peers/clock.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <hwy/aligned_allocator.h>

#define SIMD_FILE "bench/peers/core_limits.cpp"
#include "simd/for_each_target.h"

SIMD_BEGIN(scanout::bench)

constexpr std::size_t kStep = 4 * kLanes;

// Four sums, none of which waits for another.
float sum(const float* values, std::size_t count) {
    F32 a(0.0F), b = a, c = a, d = a;
    for (std::size_t i = 0; i < count; i += kStep) {
        a = a + load<F32>(values + i);
        b = b + load<F32>(values + i + kLanes);
        c = c + load<F32>(values + i + 2 * kLanes);
        d = d + load<F32>(values + i + 3 * kLanes);
    }
    alignas(64) float lanes[kLanes];
    store((a + b) + (c + d), lanes);
    return lanes[0];
}

void write(float* values, std::size_t count) {
    for (std::size_t i = 0; i < count; i += kLanes)
        stream(F32(2.0F), values + i);
    finish_streams();
}

SIMD_END

#if SIMD_ONCE
namespace scanout::bench {
namespace {

SIMD_REGISTER(sum);
SIMD_REGISTER(write);

constexpr int kTries = 5;
constexpr std::size_t kFloats = 16 << 20; // more than a core's own caches hold

// The least of some turns, in seconds.
template <class F>
double least_seconds(F&& turn) {
    Times times;
    for (int i = 0; i < kTries; ++i)
        times.add(turn);
    return times.cpu_least() * 1e-3;
}

// Steps of two cycles on every processor: a shift, and what waits for it.
double clock_of_core() {
    constexpr int kSteps = 2'000'000;
    std::uint64_t x = 1;
    const double seconds = least_seconds([&] {
        for (int i = 0; i < kSteps; ++i) {
            x ^= x << 1;
            asm volatile("" : "+r"(x));
        }
    });
    return 2.0 * kSteps / seconds;
}

} // namespace

CoreLimits measure_core() {
    const auto memory = hwy::AllocateAligned<float>(kFloats);
    const double bytes = kFloats * sizeof(float);
    CoreLimits limits;
    limits.clock = clock_of_core();
    std::fill_n(memory.get(), kFloats, 1.0F); // its pages are there
    limits.write = bytes / least_seconds([&] { SIMD_CALL(write)(memory.get(), kFloats); });
    volatile float kept = 0;
    limits.read = bytes / least_seconds([&] { kept = SIMD_CALL(sum)(memory.get(), kFloats); });
    static_cast<void>(kept);
    return limits;
}

} // namespace scanout::bench
#endif
