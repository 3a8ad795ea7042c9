#include "bench/peers/report.h"

#include <algorithm>
#include <iterator>

namespace scanout::bench {
namespace {

std::string bounds(double gate, double goal) {
    return gate == 0 ? "-" : fmt::format("{}x / {}x", gate, goal);
}

// Floors are judged of loads that have a gate (the teapot's depth has none); the model knows one
// sample.
bool has_floor(const Load& load) {
    return load.gate > 0 && load.samples == 1;
}

class Judge {
public:
    template <class... Args>
    void gate(bool met, fmt::format_string<Args...> otherwise, Args&&... args) {
        ++verdicts.judged;
        if (!met) miss(otherwise, std::forward<Args>(args)...);
    }
    template <class... Args>
    void miss(fmt::format_string<Args...> line, Args&&... args) {
        verdicts.missed.push_back(fmt::format(line, std::forward<Args>(args)...));
    }

    Verdicts verdicts;
};

void judge_load(Judge& judge, const Load& load, const Duel& duel) {
    const Difference& difference = duel.difference;
    if (load.gate > 0)
        judge.gate(duel.ratio() >= load.gate, "{}: {:.2f}x, the gate is {}x", load.name,
                   duel.ratio(), load.gate);
    judge.gate(difference.flip <= kMaxFlip, "{}: the pictures differ by FLIP {:.4f}, more than {}",
               load.name, difference.flip, kMaxFlip);
    judge.gate(difference.one_sided <= kMaxOneSided,
               "{}: one side alone covers {:.2f} % of the pixels that either does, more than {} %",
               load.name, difference.one_sided * 100, kMaxOneSided * 100);
    if (has_first_frame(load) && duel.first == 0)
        judge.miss("{}: not judged: no process drew its first frame", load.name);
    else if (has_first_frame(load))
        judge.gate(duel.first <= kFirstGate,
                   "{}: the first frame takes {:.2f} steady ones, the gate is {}", load.name,
                   duel.first, kFirstGate);
    if (!has_floor(load)) return;
    if (duel.floor > 0 && duel.above_floor() < 1)
        judge.gate(false, "{}: faster than its floor of {:.2f} ms, which is wrong", load.name,
                   duel.floor);
    else if (duel.floor > 0)
        judge.gate(duel.above_floor() <= kFloorGate,
                   "{}: {:.2f} times the floor of {:.2f} ms, the gate is {}", load.name,
                   duel.above_floor(), duel.floor, kFloorGate);
    else
        judge.miss("{}: not judged: its floor is not known", load.name);
}

void judge_threads(Judge& judge, const Load& load, const ThreadsResult& threads) {
    if (threads.judged())
        judge.gate(threads.relative() >= kThreadsGate,
                   "two threads, {}: {:.2f}x beside a pair that computes at {:.2f}x, so {:.2f}x; "
                   "the gate is {}x",
                   load.name, threads.ours, threads.compute, threads.relative(), kThreadsGate);
    else
        judge.miss("two threads, {}: not judged: {:.2f}x beside a pair that computes at {:.2f}x is "
                   "other work on the machine",
                   load.name, threads.ours, threads.compute);
}

// What the floors stand on, the least and the most beside any load.
std::string limits_of_core(const Report& r) {
    const auto range = [&](double CoreLimits::*limit) {
        std::vector<double> all;
        for (const auto& [load, duel] : r.duels)
            all.push_back(duel.core.*limit * 1e-9);
        const auto [least, most] = std::minmax_element(all.begin(), all.end());
        return fmt::format("{:.1f} to {:.1f}", *least, *most);
    };
    return fmt::format("The core: {} GHz, writes {} GB/s, reads {} GB/s.\n",
                       range(&CoreLimits::clock), range(&CoreLimits::write),
                       range(&CoreLimits::read));
}

void print_lesser(std::string& text, const Report& r) {
    const auto out = std::back_inserter(text);
    if (r.duels.empty()) return;
    fmt::format_to(
        out,
        "\n{}\n| less is better | first / steady | {} | floor ms | times the floor | {} |\n"
        "|---|--:|---|--:|--:|---|\n",
        limits_of_core(r), bounds(kFirstGate, kFirstGoal), bounds(kFloorGate, kFloorGoal));
    for (const auto& [load, d] : r.duels) {
        if (!has_first_frame(load) && !has_floor(load)) continue;
        const auto cells = [](bool known, auto... parts) {
            return known ? fmt::format("{:.2f} | {}", parts...) : std::string("- | -");
        };
        fmt::format_to(out, "| {} | {} | {} |\n", load.name,
                       cells(has_first_frame(load) && d.first > 0, d.first,
                             verdict(d.first, kFirstGate, kFirstGoal, true)),
                       has_floor(load) && d.floor > 0
                           ? fmt::format("{:.2f} | {:.2f} | {}", d.floor, d.above_floor(),
                                         verdict(d.above_floor(), kFloorGate, kFloorGoal, true))
                           : "- | - | -");
    }
}

} // namespace

std::string verdict(double value, double gate, double goal, bool less_is_better) {
    if (gate == 0) return "-";
    const auto meets = [&](double bound) {
        return less_is_better ? value <= bound : value >= bound;
    };
    const double short_by = less_is_better ? value / gate : gate / value;
    const double to_goal = less_is_better ? value / goal : goal / value;
    if (meets(goal)) return "goal met";
    if (meets(gate)) return fmt::format("gate met, goal short by {:.2f}x", to_goal);
    return fmt::format("MISSED by {:.2f}x", short_by);
}

bool has_first_frame(const Load& load) {
    return load.shading != Shading::depth;
}

bool has_threads(const Load& load) {
    return load.shading == Shading::blinn_phong && load.samples == 1;
}

int gates_of(std::span<const Load> loads) {
    int count = 0;
    for (const Load& load : loads)
        count += 2 + int{load.gate > 0} + int{has_first_frame(load)} + int{has_floor(load)} +
                 int{has_threads(load)};
    return count;
}

Verdicts judge(const Report& report) {
    Judge judge;
    for (const auto& [load, duel] : report.duels)
        judge_load(judge, load, duel);
    for (const auto& [load, threads] : report.threads)
        judge_threads(judge, load, threads);
    for (const auto& [load, why] : report.left_out)
        judge.miss("{}: left out, not judged: {}", load.name, why);
    for (const auto& [load, duel] : report.duels)
        judge.verdicts.asked += gates_of({&load, 1});
    for (const auto& [load, why] : report.left_out)
        judge.verdicts.asked += gates_of({&load, 1});
    return std::move(judge.verdicts);
}

std::string count_line(const Verdicts& verdicts, int all) {
    std::string line = fmt::format("{} of {} gates judged", verdicts.judged, all);
    if (verdicts.asked == all) return line;
    return fmt::format("{}; {} were not asked for (--only)", line, all - verdicts.asked);
}

std::string to_markdown(const Report& r) {
    std::string text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out,
                   "{}x{}, one thread on one core; {}; {}; target {}; peer {}; load average {:.1f} "
                   "to {:.1f}\n\n",
                   r.width, r.height, r.cpu, r.compiler, r.target, r.peer, r.load_before,
                   r.load_after);
    fmt::format_to(out, "| load | triangles | Mfrag | llvmpipe ms | scanout ms | ratio | by wall | "
                        "gate / goal | verdict | FLIP | one side alone |\n"
                        "|---|--:|--:|--:|--:|--:|--:|--:|---|--:|--:|\n");
    for (const auto& [load, d] : r.duels)
        fmt::format_to(out,
                       "| {} | {} | {:.2f} | {:.2f} | {:.2f} | **{:.2f}x** | {:.2f}x | {} | {} | "
                       "{:.4f} | {:.3f} % |\n",
                       load.name, d.triangles, d.fragments * 1e-6, d.theirs.cpu_median(),
                       d.ours.cpu_median(), d.ratio(), d.wall_ratio(), bounds(load.gate, load.goal),
                       verdict(d.ratio(), load.gate, load.goal), d.difference.flip,
                       d.difference.one_sided * 100);
    print_lesser(text, r);
    if (r.threads.empty()) return text;
    fmt::format_to(out,
                   "\n| two threads against one | ours | pure compute | relative | gate / goal "
                   "| verdict |\n|---|--:|--:|--:|--:|---|\n");
    for (const auto& [load, t] : r.threads)
        fmt::format_to(out, "| {} | {:.2f}x | {:.2f}x | **{:.2f}x** | {} | {} |\n", load.name,
                       t.ours, t.compute, t.relative(), bounds(kThreadsGate, kThreadsGoal),
                       t.judged() ? verdict(t.relative(), kThreadsGate, kThreadsGoal)
                                  : "not judged");
    return text;
}

std::string to_json(const Report& r) {
    std::string text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out,
                   "{{\"cpu\": \"{}\", \"compiler\": \"{}\", \"target\": \"{}\", \"peer\": \"{}\", "
                   "\"load_average\": [{}, {}], \"size\": [{}, {}],\n \"loads\": [",
                   r.cpu, r.compiler, r.target, r.peer, r.load_before, r.load_after, r.width,
                   r.height);
    const char* comma = "";
    for (const auto& [load, d] : r.duels) {
        fmt::format_to(
            out,
            "{}\n  {{\"name\": \"{}\", \"triangles\": {}, \"drawn\": {}, \"fragments\": {}, "
            "\"llvmpipe_ms\": {{\"cpu\": {:.4f}, \"wall\": {:.4f}, \"least\": {:.4f}}}, "
            "\"scanout_ms\": {{\"cpu\": {:.4f}, \"wall\": {:.4f}, \"least\": {:.4f}}}, "
            "\"ratio\": {:.3f}, \"gate\": {}, \"goal\": {}, \"first\": {:.3f}, \"floor_ms\": "
            "{:.4f}, \"flip\": {:.5f}, \"one_sided\": {:.6f}}}",
            std::exchange(comma, ","), load.name, d.triangles, d.drawn, d.fragments,
            d.theirs.cpu_median(), d.theirs.wall_median(), d.theirs.wall_least(),
            d.ours.cpu_median(), d.ours.wall_median(), d.ours.wall_least(), d.ratio(), load.gate,
            load.goal, d.first, d.floor, d.difference.flip, d.difference.one_sided);
    }
    fmt::format_to(out, "],\n \"two_threads\": [");
    comma = "";
    for (const auto& [load, t] : r.threads)
        fmt::format_to(out,
                       "{}\n  {{\"name\": \"{}\", \"ours\": {:.3f}, \"compute\": {:.3f}, "
                       "\"relative\": {:.3f}}}",
                       std::exchange(comma, ","), load.name, t.ours, t.compute, t.relative());
    return text + "]}\n";
}

} // namespace scanout::bench
