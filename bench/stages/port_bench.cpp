// The last step of a frame: from the back buffer to the bytes of a display, for every pixel format,
// and for the small part that changes when only the overlay does.
#include "image/pixel_format.h"
#include "port/headless.h"

#include <array>
#include <string>

#include <benchmark/benchmark.h>

namespace {

using namespace scanout;

constexpr int kWidth = 1920, kHeight = 1080;

// Gradients: every code of every channel.
image::Image gradients() {
    image::Image picture(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            picture.at(x, y) = {static_cast<std::uint8_t>(x / 3 + y),
                                static_cast<std::uint8_t>(x + y / 5),
                                static_cast<std::uint8_t>(255 - x / 2), 255};
    return picture;
}

void present(benchmark::State& state, const image::PixelFormat& format, const image::Rect& rect) {
    auto display = port::HeadlessDisplay::create(kWidth, kHeight, format);
    if (!display) return state.SkipWithError(display.error().what.c_str());
    const image::Image picture = gradients();
    const std::array damage{rect};
    for (auto _ : state) {
        const auto shown = display->present(picture, damage);
        if (!shown) return state.SkipWithError(shown.error().what.c_str());
        benchmark::DoNotOptimize(display->bytes().data());
        benchmark::ClobberMemory();
    }
    const double pixels = double(rect.width()) * double(rect.height());
    state.counters["pixels"] =
        benchmark::Counter(pixels, benchmark::Counter::kIsIterationInvariantRate);
}

const bool kRegistered = [] {
    const image::Rect whole{0, 0, kWidth, kHeight}, overlay{16, 16, 336, 116};
    for (const image::NamedPixelFormat& named : image::pixel_formats()) {
        const std::string name(named.name);
        benchmark::RegisterBenchmark(("present/frame/" + name).c_str(), present, named.format,
                                     whole)
            ->Unit(benchmark::kMicrosecond);
    }
    for (const std::string name : {"xrgb8888", "rgb565"})
        benchmark::RegisterBenchmark(("present/overlay/" + name).c_str(), present,
                                     *image::pixel_format(name), overlay)
            ->Unit(benchmark::kMicrosecond);
    return true;
}();

} // namespace
