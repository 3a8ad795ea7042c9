#include "bench/peers/core_limits.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

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

constexpr std::size_t kFloats = 16 << 20; // more than a core's own caches hold
constexpr double kBytes = kFloats * sizeof(float);
constexpr int kSteps = 2'000'000;

// Steps of two cycles on every processor: a shift, and what waits for it.
void step() {
    std::uint64_t x = 1;
    for (int i = 0; i < kSteps; ++i) {
        x ^= x << 1;
        asm volatile("" : "+r"(x));
    }
}

} // namespace

CoreMeter::CoreMeter()
    : read_from_(hwy::AllocateAligned<float>(kFloats)),
      written_(hwy::AllocateAligned<float>(kFloats)) {
    for (const auto* memory : {&read_from_, &written_}) // their pages are there
        std::fill_n(memory->get(), kFloats, 1.0F);
}

void CoreMeter::measure() {
    clock_.add(step);
    const auto add = [](Times& to, const auto& work) {
        Times twice; // what was there before slows the first
        twice.add(work);
        twice.add(work);
        to.cpu.push_back(twice.cpu_least());
    };
    add(write_, [&] { SIMD_CALL(write, written_.get(), kFloats); });
    volatile float kept = 0;
    add(read_, [&] { kept = SIMD_CALL(sum, read_from_.get(), kFloats); });
    static_cast<void>(kept);
}

CoreLimits CoreMeter::typical() const {
    const auto a_second = [](double count, const Times& times) {
        return count / (times.cpu_median() * 1e-3);
    };
    return {a_second(2.0 * kSteps, clock_), a_second(kBytes, write_), a_second(kBytes, read_)};
}

} // namespace scanout::bench
#endif
