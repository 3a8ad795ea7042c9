// bench_draw MODEL WIDTHxHEIGHT THREADS SECONDS: loads a model as scanout does, on all cores, turns
// it before the camera, and prints as JSON what loading and a frame took: milliseconds that the
// process ran, milliseconds of wall time, and its peak memory. After each frame the same threads do
// as much work that is sums alone: how much faster these get with more threads is what the machine
// has to give while other work runs. bench/growth.py runs this once for every figure.
#include "base/check.h"
#include "base/jobs.h"
#include "base/stopwatch.h"
#include "frame/plan/plan_cache.h"
#include "frame/renderer.h"
#include "io/load.h"
#include "measure/median.h"
#include "simd/targets.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sys/resource.h>

namespace scanout::bench {
namespace {

// Of all threads.
double process_milliseconds() {
    std::timespec now{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double peak_megabytes() {
    ::rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) / 1024; // kilobytes on Linux
}

struct Asked {
    std::string model;
    int width = 0, height = 0, threads = 0;
    double seconds = 0; // of frames; at least kMinFrames whatever they take
};
constexpr std::size_t kMinFrames = 5;
constexpr int kTurn = 36; // frames of a full turn: triangles are not always seen from one side

constexpr double kSumsPart = 0.035; // about; milliseconds

struct Times {
    std::vector<double> cpu, wall, sums;
};

// Wall time of each of `parts` like sums, on all threads.
double sums_milliseconds(Jobs& jobs, int parts) {
    std::vector<std::uint64_t> found(static_cast<std::size_t>(parts));
    const Stopwatch watch;
    jobs.for_each(parts, [&](int index, int) {
        std::uint64_t x = static_cast<std::uint64_t>(index) + 1;
        for (int i = 0; i < 20'000; ++i) { // xorshift
            x ^= x << 13;
            x ^= x >> 7;
            x ^= x << 17;
        }
        found[static_cast<std::size_t>(index)] = x;
    });
    const double took = watch.milliseconds();
    CHECK(std::count(found.begin(), found.end(), std::uint64_t{0}) == 0); // so that they are found
    return took / parts;
}

Result<Times> draw(const scene::Scene& scene, const Asked& asked) {
    Jobs jobs(asked.threads);
    frame::Renderer renderer(jobs);
    frame::PlanCache kept(frame::facts(scene));
    frame::FrameOptions options;
    options.width = asked.width;
    options.height = asked.height;
    Times times;
    int parts = 1;
    const Stopwatch all;
    for (int number = 0; times.cpu.size() < kMinFrames || all.milliseconds() < asked.seconds * 1e3;
         ++number) {
        scene::Pose pose;
        pose.yaw = scene::wrap_angle(std::int64_t{scene::kFullTurn} * number / kTurn);
        const Stopwatch watch;
        const double before = process_milliseconds();
        TRY(const scene::View view,
            scene::make_view(scene.mesh, {}, pose, {}, {}, asked.width, asked.height));
        TRY(const frame::FramePlan* const plan, kept.plan(options, view));
        renderer.render(scene, view, *plan);
        if (number == 0) { // it makes the buffers, and says how many sums take as long
            parts = std::max(1, static_cast<int>((process_milliseconds() - before) / kSumsPart));
            continue;
        }
        times.cpu.push_back(process_milliseconds() - before);
        times.wall.push_back(watch.milliseconds());
        times.sums.push_back(sums_milliseconds(jobs, parts));
    }
    return times;
}

struct Loaded {
    scene::Scene scene;
    int threads = 0; // that loaded it
};

Result<Loaded> load_on_all_cores(const std::string& model) {
    Jobs jobs;
    io::LoadOptions options;
    options.jobs = &jobs;
    Warnings warnings;
    TRY(scene::Scene scene, io::load(model, options, warnings));
    return Loaded{std::move(scene), jobs.threads()};
}

Result<void> run(const Asked& asked) {
    const Stopwatch watch;
    TRY(const Loaded loaded, load_on_all_cores(asked.model));
    const scene::Scene& scene = loaded.scene;
    const double load_wall = watch.milliseconds(), load_cpu = process_milliseconds();
    const double load_peak = peak_megabytes();
    TRY(const Times times, draw(scene, asked));
    fmt::print(
        "{{\"triangles\": {}, \"target\": \"{}\", \"load_threads\": {}, \"load_ms\": {:.3f}, "
        "\"load_cpu_ms\": {:.3f}, \"load_mb\": {:.1f}, \"frames\": {}, "
        "\"cpu_ms\": {:.4f}, \"wall_ms\": {:.4f}, \"sums_ms\": {:.6f}, \"peak_mb\": {:.1f}}}\n",
        scene.mesh.triangles(), simd::chosen_target(), loaded.threads, load_wall, load_cpu,
        load_peak, times.cpu.size(), measure::median(times.cpu), measure::median(times.wall),
        measure::median(times.sums), peak_megabytes());
    return {};
}

} // namespace
} // namespace scanout::bench

int main(int count, char** arguments) {
    using namespace scanout;
    bench::Asked asked;
    if (count != 5 || std::sscanf(arguments[2], "%dx%d", &asked.width, &asked.height) != 2) {
        fmt::print(stderr, "usage: bench_draw MODEL WIDTHxHEIGHT THREADS SECONDS\n");
        return static_cast<int>(Exit::usage);
    }
    asked.model = arguments[1];
    asked.threads = std::atoi(arguments[3]);
    asked.seconds = std::atof(arguments[4]);
    const Result<void> done = bench::run(asked);
    if (done) return 0;
    fmt::print(stderr, "bench_draw: {}\n", done.error().what);
    return static_cast<int>(done.error().exit);
}
