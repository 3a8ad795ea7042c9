#include "app/frontier/report.h"

#include <algorithm>

#include <fmt/format.h>

namespace scanout::app {
namespace {

using measure::Frontier;
using measure::Ladder;
using measure::LadderRung;

// What more time buys, from the knee on.
std::string beyond(const Frontier& found) {
    const std::vector<measure::TimedError> set = found.timed_errors();
    const std::size_t knee = measure::knee_of(set);
    const std::optional<std::size_t> buy = measure::best_buy(set, knee);
    if (!buy) return "nothing more accurate was found.";
    const double times = set[*buy].time / set[knee].time;
    return fmt::format("{} the time buys {:.2f} codes.",
                       times <= 2 ? "twice" : fmt::format("{:.1f} times", times),
                       set[knee].error - set[*buy].error);
}

std::string knee_sentence(const FrontierReport& report) {
    const Frontier& found = report.found;
    const std::size_t knee = *found.knee();
    return fmt::format("Knee: {}: {:.2f} codes RMSE at {:.2f} ms a frame ({} ms of CPU time); {}",
                       report.name_of(knee), found.error(knee), found.wall_ms(knee),
                       report.cpu_text(knee), beyond(found));
}

// The measurement was stopped before anything but the picture as asked for was timed.
bool nothing_compared(const Frontier& found) {
    const auto& points = found.points->all();
    return found.stopped && found.effects.empty() &&
           std::none_of(points.begin() + 1, points.end(),
                        [](const measure::Point& p) { return p.price.has_value(); });
}

// Of a picture without effects: the technique that takes most over the quickest of its axis. How
// many pixels are drawn is no technique.
std::string technique_sentence(const FrontierReport& report) {
    const Frontier& found = report.found;
    const auto ratio = [&](std::size_t point) { return (*found.points)[point].price->cpu_ratio; };
    std::string axis, own, quickest;
    std::size_t without = 0;
    for (const Ladder& ladder : found.ladders) {
        if (ladder.is_flat() || ladder.axis == "render_scale") continue;
        const LadderRung* asked = nullptr;
        const LadderRung* least = nullptr;
        for (const LadderRung& rung : ladder.rungs) {
            if (!rung.point || !(*found.points)[*rung.point].price) continue;
            if (*rung.point == 0) asked = &rung;
            if (ratio(*rung.point).high < 1 &&
                (least == nullptr || ratio(*rung.point).median < ratio(*least->point).median))
                least = &rung;
        }
        if (asked == nullptr || least == nullptr ||
            (!axis.empty() && ratio(*least->point).median >= ratio(without).median))
            continue;
        axis = ladder.axis;
        own = asked->technique;
        quickest = least->technique;
        without = *least->point;
    }
    if (axis.empty())
        return "Dearest effect: none takes a time that can be measured, and no technique is "
               "quicker "
               "than those in use.";
    const std::string share =
        fmt::format("Dearest technique, as no effect takes a time that can be measured: {} {}: "
                    "{:.0f} % of the frame's CPU time, over {}",
                    axis, own, 100 * (1 - ratio(without).median), quickest);
    if (!report.compared()) return share + ".";
    const double gain = found.error(without) - found.error(0);
    return gain > 0.005 ? fmt::format("{}, for {:.2f} codes.", share, gain)
                        : share + ", for no more accuracy here.";
}

std::string effect_sentence(const FrontierReport& report) {
    const Frontier& found = report.found;
    if (nothing_compared(found)) return "Dearest effect: not measured.";
    const measure::EffectPrice* dearest = nullptr;
    for (const measure::EffectPrice& e : found.effects) {
        if (e.price.by_construction || e.price.cpu_ms.is_zero()) continue;
        if (dearest == nullptr || e.price.cpu_ms.median > dearest->price.cpu_ms.median)
            dearest = &e;
    }
    if (dearest == nullptr || dearest->price.cpu_ms.median <= 0) return technique_sentence(report);
    const double share = 1 - 1 / dearest->price.cpu_ratio.median;
    return fmt::format("Dearest effect: {}{}: {:.0f} % of the frame's CPU time; it changes {:.1f} "
                       "% of the pixels.",
                       dearest->effect, dearest->technique == "on" ? "" : " " + dearest->technique,
                       share * 100, dearest->changed_share * 100);
}

// The highest rung that is as accurate as any, to a tenth of a code, and whose time cannot be told
// from that of the quickest; none where that is the lowest.
std::string free_rung(const Frontier& found, const Ladder& ladder) {
    constexpr double kTold = 0.1; // codes, as squares add up
    double least_error = 1e9, quickest = 1e9;
    std::vector<const LadderRung*> timed;
    for (const LadderRung& rung : ladder.rungs) {
        if (!rung.point || !(*found.points)[*rung.point].price) continue;
        timed.push_back(&rung);
        least_error = std::min(least_error, found.error(*rung.point));
        quickest = std::min(quickest, (*found.points)[*rung.point].price->cpu_ratio.high);
    }
    const auto free = std::find_if(timed.rbegin(), timed.rend(), [&](const LadderRung* rung) {
        const double error = found.error(*rung->point);
        return error * error <= least_error * least_error + kTold * kTold &&
               (*found.points)[*rung->point].price->cpu_ratio.low <= quickest;
    });
    if (free == timed.rend() || *free == timed.front()) return {};
    return fmt::format("{} {}", ladder.axis, (*free)->technique);
}

std::string free_sentence(const Frontier& found) {
    if (nothing_compared(found)) return "Free: not measured.";
    std::vector<std::string> free;
    for (const Ladder& ladder : found.ladders)
        if (std::string rung = free_rung(found, ladder); !ladder.is_flat() && !rung.empty())
            free.push_back(std::move(rung));
    if (free.empty() && !found.untimed_rungs().empty()) return "Free: nothing that was timed.";
    if (free.empty()) return "Free: no rung but the cheapest of each axis.";
    return fmt::format("Free: {}: no more CPU time than the quickest rung of the axis.",
                       fmt::join(free, ", "));
}

} // namespace

std::vector<std::string> frontier_sentences(const FrontierReport& report) {
    if (report.timed() && !report.compared()) return {effect_sentence(report)};
    if (!report.has_frontier()) return {};
    return {knee_sentence(report), effect_sentence(report), free_sentence(report.found)};
}

} // namespace scanout::app
