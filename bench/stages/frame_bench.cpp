// Whole frames at 1920x1080 on one thread, plan included, as a viewer draws while the model turns:
// the meshes and shadings of bench_peers, without the peer; and first frames in Blinn-Phong.
#include "base/jobs.h"
#include "bench/peers/load.h"
#include "bench/peers/ours.h"

#include <memory>
#include <string>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

namespace {

using namespace scanout;
using bench::Load;
using bench::Shading;

constexpr int kWidth = 1920, kHeight = 1080, kTurn = 36; // frames of a full turn

// A benchmark is called several times, to find out how often it must draw, and a mesh takes seconds
// to make: the last load's is kept.
const Result<scene::Scene>& kept_scene(const Load& load) {
    static std::string of;
    static Result<scene::Scene> scene;
    const std::string name = fmt::format("{} {}", load.mesh, load.name);
    if (name != of) {
        of = name;
        scene = bench::scene_of(load);
    }
    return scene;
}

void frame_of(benchmark::State& state, const Load& load) {
    const Result<scene::Scene>& scene = kept_scene(load);
    if (!scene) return state.SkipWithError(scene.error().what.c_str());
    Jobs jobs(1);
    bench::Ours ours(jobs, *scene, load, kWidth, kHeight);
    int number = 0;
    const auto draw = [&]() -> Result<void> {
        TRY(const scene::View view,
            bench::view_of(load, *scene, number++ % kTurn, kTurn, kWidth, kHeight));
        return ours.draw(view);
    };
    auto drawn = draw(); // makes the buffers and mipmaps
    for (auto _ : state) {
        if (drawn) drawn = draw();
        benchmark::ClobberMemory();
    }
    if (!drawn) return state.SkipWithError(drawn.error().what.c_str());
    const auto rate = benchmark::Counter::kIsIterationInvariantRate;
    state.counters["triangles"] =
        benchmark::Counter(static_cast<double>(scene->mesh.triangles()), rate);
    state.counters["pixels"] = benchmark::Counter(double{kWidth} * kHeight, rate);
}

// A new renderer, with all its buffers to make.
void first_frame_of(benchmark::State& state, const Load& load) {
    const Result<scene::Scene>& scene = kept_scene(load);
    if (!scene) return state.SkipWithError(scene.error().what.c_str());
    const auto view = bench::view_of(load, *scene, 0, kTurn, kWidth, kHeight);
    if (!view) return state.SkipWithError(view.error().what.c_str());
    Jobs jobs(1);
    Result<void> drawn;
    for (auto _ : state) {
        state.PauseTiming();
        auto fresh = std::make_unique<bench::Ours>(jobs, *scene, load, kWidth, kHeight);
        state.ResumeTiming();
        if (drawn) drawn = fresh->draw(*view);
        state.PauseTiming();
        fresh.reset();
        state.ResumeTiming();
    }
    if (!drawn) state.SkipWithError(drawn.error().what.c_str());
}

const bool kRegistered = [] {
    const struct {
        const char* name;
        Shading shading;
        int samples;
    } kinds[] = {{"depth", Shading::depth, 1},
                 {"blinn_phong", Shading::blinn_phong, 1},
                 {"textured", Shading::textured, 1},
                 {"shadow_map", Shading::shadowed, 1},
                 {"4_samples", Shading::blinn_phong, 4}};
    for (const char* mesh : {"teapot", "bunny", "dragon", "building", "crate"})
        for (const auto& kind : kinds)
            benchmark::RegisterBenchmark((std::string(mesh) + "/" + kind.name).c_str(), frame_of,
                                         Load{kind.name, mesh, kind.shading, kind.samples, 0, 0})
                ->Unit(benchmark::kMillisecond);
    for (const char* mesh : {"teapot", "bunny", "dragon"})
        benchmark::RegisterBenchmark((std::string(mesh) + "/first").c_str(), first_frame_of,
                                     Load{"blinn_phong", mesh, Shading::blinn_phong, 1, 0, 0})
            ->Unit(benchmark::kMillisecond);
    return true;
}();

} // namespace
