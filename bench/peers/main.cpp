// bench_peers [--check] [--json] [--placed] [--frames N] [--size WxH] [--only TEXT] [--save FOLDER]
//     [--dragon FILE]
#include "bench/peers/gl_context.h"
#include "bench/peers/machine.h"
#include "bench/peers/report.h"
#include "simd/targets.h"

#include <cstdio>
#include <span>
#include <string_view>

namespace {

using namespace scanout;
using namespace scanout::bench;

struct Arguments {
    DuelOptions duel;
    bool check = false, json = false;
    std::string only;   // loads whose name holds it
    std::string dragon; // a file in the place of the generated one
};

constexpr const char* kUsage =
    "usage: bench_peers [--check] [--json] [--placed] [--frames N] [--size WxH] [--only TEXT] "
    "[--save FOLDER] [--dragon FILE.obj]";

Result<Arguments> read_arguments(std::span<char*> words) {
    Arguments a;
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string_view word = words[i];
        if (word == "--check") {
            a.check = true;
            continue;
        }
        if (word == "--json") {
            a.json = true;
            continue;
        }
        if (word == "--placed") {
            a.duel.placed = true;
            continue;
        }
        if (i + 1 == words.size()) return fail(Exit::usage, "{}: {}", word, kUsage);
        const char* value = words[++i];
        DuelOptions& d = a.duel;
        const bool fine =
            word == "--only"     ? (a.only = value, true)
            : word == "--save"   ? (d.save_in = value, true)
            : word == "--dragon" ? (a.dragon = value, true)
            : word == "--frames" ? std::sscanf(value, "%d", &d.frames) == 1 && d.frames > 0
            : word == "--size"
                ? std::sscanf(value, "%dx%d", &d.width, &d.height) == 2 && d.width > 0 &&
                      d.height > 0 && d.width <= frame::kMaxSide && d.height <= frame::kMaxSide
                : false;
        if (!fine) return fail(Exit::usage, "{} {}: {}", word, value, kUsage);
    }
    return a;
}

// A load whose model is not there is left out, and said.
Result<void> measure(const Load& load, const Arguments& a, Jobs& two, Report& report) {
    Result<scene::Scene> scene = scene_of(load);
    if (!scene && scene.error().exit == Exit::unreadable) {
        fmt::print(stderr, "bench_peers: {} left out: {}\n", load.name, scene.error().what);
        return {};
    }
    if (!scene) return tl::unexpected(scene.error());
    fmt::print(stderr, "{} ...\n", load.name);
    stay_on_one_core();
    TRY(Duel result, duel(load, *scene, a.duel));
    run_anywhere();
    report.duels.emplace_back(load, std::move(result));
    const bool threads_too = load.shading == Shading::blinn_phong && load.samples == 1;
    if (!threads_too) return {};
    TRY(const ThreadsResult threads,
        measure_threads(load, *scene, two, a.duel.width, a.duel.height, a.duel.frames));
    report.threads.emplace_back(load, threads);
    return {};
}

Result<Exit> run(std::span<char*> words) {
    TRY(const Arguments a, read_arguments(words));
    TRY(const GlContext context, GlContext::create());
    run_anywhere(); // remembers where that is
    Jobs two(2);
    two.for_each(64, [](int, int) {}); // its workers are made, free to run on every core
    Report report;
    report.cpu = cpu_name();
    report.compiler = compiler_name();
    report.peer = context.version();
    report.target = simd::chosen_target();
    report.width = a.duel.width;
    report.height = a.duel.height;
    report.load_before = load_average();
    for (Load load : loads()) {
        if (load.name.find(a.only) == std::string_view::npos) continue;
        if (load.mesh == "dragon" && !a.dragon.empty()) load.mesh = a.dragon;
        TRY_VOID(measure(load, a, two, report));
    }
    report.load_after = load_average();
    if (report.duels.empty()) return fail(Exit::usage, "no load has a name with {}", a.only);
    fmt::print("{}", a.json ? to_json(report) : to_markdown(report));
    const std::vector<std::string> missed = missed_gates(report);
    for (const std::string& line : missed)
        fmt::print(stderr, "{}{}\n", a.check ? "MISSED " : "", line);
    return a.check && !missed.empty() ? Exit::pixels_differ : Exit::ok;
}

} // namespace

int main(int count, char** words) {
    const Result<Exit> exit = run({words, static_cast<std::size_t>(count)});
    if (exit) return *exit == Exit::ok ? 0 : 1;
    fmt::print(stderr, "bench_peers: {}\n", exit.error().what);
    return static_cast<int>(exit.error().exit);
}
