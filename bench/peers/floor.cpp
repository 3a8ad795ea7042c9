#include "bench/peers/floor.h"

#include "bench/peers/clock.h"

#include <algorithm>
#include <cstdint>

#include <hwy/aligned_allocator.h>
#include <hwy/cache_control.h>
#include <hwy/highway.h>

namespace scanout::bench {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<float>;

constexpr int kTries = 5;
constexpr std::size_t kFloats = 16 << 20; // 64 MB: more than a core's share of any cache

// The least of some turns, in seconds.
template <class F>
double least_seconds(F&& turn) {
    Times times;
    for (int i = 0; i < kTries; ++i)
        times.add(turn);
    return *std::min_element(times.cpu.begin(), times.cpu.end()) * 1e-3;
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
    const Tag tag;
    const auto memory = hwy::AllocateAligned<float>(kFloats);
    const double bytes = kFloats * sizeof(float);
    CoreLimits limits;
    limits.clock = clock_of_core();
    std::fill_n(memory.get(), kFloats, 1.0F); // its pages are there
    limits.write = bytes / least_seconds([&] {
                       for (std::size_t i = 0; i < kFloats; i += hn::Lanes(tag))
                           hn::Stream(hn::Set(tag, 2.0F), tag, memory.get() + i);
                       hwy::FlushStream();
                   });
    limits.read = bytes / least_seconds([&] {
                      auto sum = hn::Zero(tag), other = sum;
                      for (std::size_t i = 0; i < kFloats; i += 2 * hn::Lanes(tag)) {
                          sum = hn::Add(sum, hn::Load(tag, memory.get() + i));
                          other = hn::Add(other, hn::Load(tag, memory.get() + i + hn::Lanes(tag)));
                      }
                      volatile float sink = hn::GetLane(hn::Add(sum, other));
                      static_cast<void>(sink);
                  });
    return limits;
}

double floor_of(const Load& load, const Work& work, const CoreLimits& core) {
    if (load.samples != 1) return 0;
    const bool lit = load.shading != Shading::depth, textured = load.shading == Shading::textured,
               shadowed = load.shading == Shading::shadowed;
    const auto vertices = static_cast<double>(work.vertices),
               triangles = static_cast<double>(work.triangles);
    // Bytes: place, normal, u and v; three indices a triangle. A shadow map is a second view.
    const double of_vertex = textured ? 32 : lit ? 24 : 12, of_triangle = 12;
    double bytes = vertices * of_vertex + triangles * of_triangle;
    // Cycles: turned vertices; triangles gathered and culled, and what is left of them set up;
    // pixels by depth alone, with light, with eight texels, with those of a shadow map.
    double cycles = vertices * (textured ? 6.5 : lit ? 6 : 3) + triangles * 4 + work.drawn * 25;
    double a_pixel = textured ? 18 : lit ? 4 : 0.6;
    if (shadowed) {
        bytes += vertices * 12 + triangles * of_triangle;
        cycles += vertices * (1.5 + 3) + triangles * 4 + work.drawn * 25 + 0.5e6;
        a_pixel += 6;
    }
    cycles += work.fragments * a_pixel;
    return (work.pixels * 4 / core.write + bytes / core.read + cycles / core.clock) * 1e3;
}

} // namespace scanout::bench
