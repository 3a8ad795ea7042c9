#include "app/frontier/budget.h"

#include "app/frontier/key.h"
#include "app/machine.h"
#include "app/options/quick.h"
#include "app/picture/reference.h"
#include "measure/frame_time.h"
#include "measure/frontier.h"
#include "scene/content.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace scanout::app {
namespace {

using measure::KnownFrontier;
using measure::KnownPoint;
using measure::Limits;

std::string milliseconds(double ms) {
    return ms < 10 ? fmt::format("{:.2f} ms", ms) : fmt::format("{:.1f} ms", ms);
}
std::string codes_rmse(double error) {
    return fmt::format("{:.2f} codes RMSE", error);
}
// Of advice: what is asked for as it is printed must not be less than what there is.
double rounded_up(double value, int digits) {
    const double scale = std::pow(10.0, digits);
    const double whole = std::ceil(value * scale);
    return (whole / scale < value ? whole + 1 : whole) / scale;
}
std::string milliseconds_at_most(double ms) {
    return milliseconds(rounded_up(ms, ms < 10 ? 2 : 1));
}
std::string codes_at_most(double error) {
    return codes_rmse(rounded_up(error, 2));
}
// As it was asked for: "0.001 ms", "1e-297 ms".
std::string asked_time(double ms) {
    return fmt::format("{:.9g} ms", ms);
}
std::string name_of(const KnownPoint& point) {
    return point.rungs.empty() ? "as asked for" : point.options();
}
std::string text_of(const Limits& limits) {
    std::string text;
    if (limits.wall_ms) text = asked_time(*limits.wall_ms);
    if (limits.error)
        text += fmt::format("{}{} codes RMSE", text.empty() ? "" : " and ", *limits.error);
    return text;
}

Result<KnownFrontier> measured(const BudgetTask& task, std::vector<std::string>& notes) {
    const auto progress = [&](std::string_view doing) {
        return [&task, doing](double fraction) {
            if (task.progress) task.progress(doing, fraction);
        };
    };
    TRY(const trace::Look look,
        look_of_rungs(task.scene, task.facts, task.view, task.options, task.max_memory_mb));
    TRY(const trace::Reference reference,
        reference_of_rungs(task.scene, task.view, look, task.jobs, {.most_samples = kQuickSamples},
                           progress("tracing"), task.stop));
    const std::vector<std::string> missing = left_out_of_reference(task.scene);
    notes.insert(notes.end(), missing.begin(), missing.end());
    measure::FrontierOptions how = quick_search(task.axes);
    how.progress = progress("measuring");
    bool stopped = false;
    how.stop = [&] { return stopped = stopped || (task.stop && task.stop()); };
    TRY(const measure::Frontier found,
        measure::frontier(task.scene, task.facts, task.view, task.options, task.jobs,
                          reference.image, how));
    KnownFrontier known = measure::known(found, today());
    if (stopped || known.points.empty())
        return fail(Exit::usage, "{}: what rungs take was not measured to its end; start again",
                    task.scene.path);
    return known;
}

// What there is instead, where nothing meets the limits.
std::string advice(const KnownFrontier& known, const Limits& limits) {
    const std::string_view of_which =
        known.complete ? "" : ", of those that there was time to measure,";
    const KnownPoint& quickest = known.points[measure::choose(known.points, {0.0, {}}).point];
    const KnownPoint& best = known.points[measure::choose(known.points, {}).point];
    if (limits.wall_ms && quickest.wall_ms > *limits.wall_ms)
        return fmt::format("--budget {}: no rungs{} are that fast; the fastest take {} ({}, {}); "
                           "ask for as much, or draw a smaller --size",
                           asked_time(*limits.wall_ms), of_which,
                           milliseconds_at_most(quickest.wall_ms), name_of(quickest),
                           codes_at_most(quickest.error));
    if (limits.error && best.error > *limits.error)
        return fmt::format("--max-error {}: no rungs{} err that little; the most accurate err {} "
                           "({}, {}); ask for as much",
                           *limits.error, of_which, codes_at_most(best.error), name_of(best),
                           milliseconds_at_most(best.wall_ms));
    const KnownPoint& accurate =
        known.points[measure::choose(known.points, {{}, limits.error}).point];
    return fmt::format("--max-error {} takes {} ({}), more than --budget {}; ask for more time, or "
                       "allow more error",
                       *limits.error, milliseconds_at_most(accurate.wall_ms), name_of(accurate),
                       asked_time(*limits.wall_ms));
}

} // namespace

std::vector<std::string> free_axes(const Settings& settings) {
    std::vector<std::string> axes;
    for (const std::string_view axis : measure::ladder_axes())
        if (settings.named_axes.count(axis) == 0) axes.emplace_back(axis);
    return axes;
}

bool still_holds(const BudgetTask& task, const KnownPoint& point) {
    constexpr double kSeconds = 0.05; // a try
    const auto plan = frame::plan(measure::with(task.options, point.rungs), task.facts, task.view);
    const auto now = [&] {
        if (task.time_now) return task.time_now(*plan);
        return measure::frame_cost(task.scene, task.view, *plan, task.jobs, kSeconds).cpu_ms;
    };
    for (int i = 0; plan && i < 3; ++i) {
        const double ms = now();
        if (ms <= point.cpu_ms * kTimeHolds && point.cpu_ms <= ms * kTimeHolds) return true;
    }
    return false;
}

Result<Chosen> choose_rungs(const BudgetTask& task, const Limits& limits,
                            const FrontierCache* cache) {
    const std::string key = frontier_key(scene::content_hash(task.scene), task.view, task.options,
                                         task.axes, task.jobs.threads());
    Chosen chosen;
    std::optional<KnownFrontier> known = cache != nullptr ? cache->find(key) : std::nullopt;
    const auto choose = [&] {
        chosen.choice = measure::choose(known->points, limits);
        chosen.point = known->points[chosen.choice.point];
    };
    if (known) {
        choose();
        // More may be measured this time.
        chosen.cached = (chosen.choice.met() || known->complete) && still_holds(task, chosen.point);
    }
    if (!chosen.cached) {
        TRY(known, measured(task, chosen.notes));
        choose();
        if (cache != nullptr)
            if (const Result<void> kept = cache->keep(key, *known); !kept)
                chosen.notes.push_back(kept.error().what + "; --budget measures anew each time");
    }
    chosen.limits = limits;
    chosen.date = known->date;
    if (!chosen.choice.met()) chosen.instead = advice(*known, limits);
    return chosen;
}

Result<Chosen> choose_rungs(const BudgetTask& task, const Limits& limits) {
    const Result<FrontierCache> cache = FrontierCache::of_user();
    TRY(Chosen chosen, choose_rungs(task, limits, cache ? &*cache : nullptr));
    if (!cache) chosen.notes.push_back(cache.error().what + "; --budget measures anew each time");
    return chosen;
}

std::string none_chosen(const Limits& limits, const Error& why) {
    return fmt::format("{}: no rungs are chosen: {}", limits.wall_ms ? "--budget" : "--max-error",
                       why.what);
}

std::string to_text(const Chosen& c) {
    return fmt::format("{} {}: {}: {}, {}; measured {}{}",
                       c.choice.met() ? "chosen for" : "nearest to", text_of(c.limits),
                       name_of(c.point), milliseconds(c.point.wall_ms), codes_rmse(c.point.error),
                       c.date, c.cached ? ", cached" : "");
}

} // namespace scanout::app
