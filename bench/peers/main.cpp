// bench_peers: the loads of bench/README.md on both sides, and which gates are met (--help).
#include "bench/peers/first_frame.h"
#include "bench/peers/gl_context.h"
#include "bench/peers/machine.h"
#include "bench/peers/report.h"
#include "simd/targets.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace scanout;
using namespace scanout::bench;

struct Arguments {
    DuelOptions duel;
    bool check = false, json = false;
    std::string only;            // loads whose name holds it
    std::string dragon;          // a file in the place of the generated one
    std::string target = "auto"; // of ours
    std::string first;           // a load of which the first frame alone is measured
};

void read_size(const std::string& text, DuelOptions& duel) {
    const auto fine = [](int side) { return side > 0 && side <= frame::kMaxSide; };
    char more = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &duel.width, &duel.height, &more) != 2 ||
        !fine(duel.width) || !fine(duel.height))
        throw CLI::ValidationError(
            "--size", fmt::format("{}: WIDTHxHEIGHT, each up to {}", text, frame::kMaxSide));
}

void describe(CLI::App& app, Arguments& a) {
    app.add_flag("--check", a.check, "exit with 1 where a gate is missed or not judged");
    app.add_flag("--json", a.json, "all figures, as JSON");
    app.add_flag("--placed", a.duel.placed,
                 "the peer gets scanout's order of triangles, not the file's");
    app.add_option("--frames", a.duel.frames, "of each side and load")
        ->check(CLI::Range(1, 1'000'000))
        ->capture_default_str();
    app.add_option_function<std::string>(
        "--size", [&](const std::string& text) { read_size(text, a.duel); },
        "of the pictures: WIDTHxHEIGHT (1920x1080)");
    app.add_option("--only", a.only, "loads whose name holds this text");
    app.add_option("--save", a.duel.save_in, "a folder for the pictures that are compared");
    app.add_option("--target", a.target,
                   "of our kernels: avx2 is what a processor without AVX-512 takes")
        ->capture_default_str();
    app.add_option("--dragon", a.dragon, "an OBJ file in the place of the dragon's stand-in")
        ->check(CLI::ExistingFile);
    CLI::Option* const first =
        app.add_option("--first", a.first,
                       "our first frame of the load with this name over the next ones, and no "
                       "more: what every load asks several processes for");
    for (const char* other : {"--check", "--json", "--placed", "--frames", "--only", "--save"})
        first->excludes(other);
}

// A load whose model is not there is left out, and not judged.
Result<void> measure(const Load& load, const Arguments& a, Jobs& two, Report& report) {
    Result<scene::Scene> scene = scene_of(load);
    if (!scene && scene.error().exit == Exit::unreadable) {
        report.left_out.emplace_back(load, scene.error().what);
        return {};
    }
    if (!scene) return tl::unexpected(scene.error());
    fmt::print(stderr, "{} ...\n", load.name);
    TRY(Duel result, duel(load, *scene, a.duel));
    run_anywhere();
    report.duels.emplace_back(load, std::move(result));
    if (!has_threads(load)) return {};
    TRY(const ThreadsResult threads,
        measure_threads(load, *scene, two, a.duel.width, a.duel.height, a.duel.frames));
    report.threads.emplace_back(load, threads);
    return {};
}

// With what the arguments say in the place of what is generated.
std::vector<Load> asked_loads(const Arguments& a) {
    std::vector<Load> asked(loads().begin(), loads().end());
    for (Load& load : asked)
        if (load.mesh == "dragon" && !a.dragon.empty()) load.mesh = a.dragon;
    return asked;
}

Result<Exit> print_first(const Arguments& a) {
    for (const Load& load : asked_loads(a))
        if (load.name == a.first) {
            TRY(const FirstFrame first, first_frame(load, a.duel.width, a.duel.height));
            fmt::print("{:.3f} (facts of the scene, known before: {:.2f} ms)\n", first.over_next,
                       first.facts_ms);
            return Exit::ok;
        }
    return fail(Exit::usage, "--first {}: no load has this name", a.first);
}

// The words for a process that prints it.
std::vector<std::string> words_for_first(const Load& load, const Arguments& a) {
    if (!has_first_frame(load)) return {};
    std::vector<std::string> words = {"--first",  std::string(load.name),
                                      "--size",   fmt::format("{}x{}", a.duel.width, a.duel.height),
                                      "--target", a.target};
    if (!a.dragon.empty()) words.insert(words.end(), {"--dragon", a.dragon});
    return words;
}

Result<Exit> run(Arguments& a) {
    if (!simd::choose_target(a.target))
        return fail(Exit::usage, "--target {}: no such target, or not of this processor", a.target);
    if (!a.first.empty()) return print_first(a);
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
    for (const Load& load : asked_loads(a)) {
        if (load.name.find(a.only) == std::string_view::npos) continue;
        a.duel.first_frame = words_for_first(load, a);
        TRY_VOID(measure(load, a, two, report));
    }
    report.load_after = load_average();
    if (report.duels.empty() && report.left_out.empty())
        return fail(Exit::usage, "no load has a name with {}", a.only);
    if (!report.duels.empty()) fmt::print("{}", a.json ? to_json(report) : to_markdown(report));
    const Verdicts verdicts = judge(report);
    for (const std::string& line : verdicts.missed)
        fmt::print(stderr, "{}{}\n", a.check ? "MISSED " : "", line);
    fmt::print(stderr, "{}\n", count_line(verdicts, gates_of(loads())));
    if (a.check && !verdicts.all_met()) return Exit::pixels_differ;
    if (report.duels.empty()) return fail(Exit::unreadable, "nothing is left to be drawn");
    return Exit::ok;
}

} // namespace

int main(int count, char** words) {
    CLI::App app("The same views on Mesa's llvmpipe and here, in turns: the table of "
                 "bench/README.md, and which gates are missed.");
    Arguments arguments;
    describe(app, arguments);
    try {
        app.parse(count, words);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : static_cast<int>(Exit::usage);
    }
    const Result<Exit> exit = run(arguments);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        fmt::print(stderr, "bench_peers: what was measured could not be written\n");
        return static_cast<int>(Exit::unreadable);
    }
    if (exit) return *exit == Exit::ok ? 0 : 1;
    fmt::print(stderr, "bench_peers: {}\n", exit.error().what);
    return static_cast<int>(exit.error().exit);
}
