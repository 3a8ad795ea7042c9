#include "measure/frontier.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace scanout::measure {

std::vector<std::size_t> pareto_set(const std::vector<TimedError>& points) {
    std::vector<std::size_t> order(points.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(points[a].time, points[a].error) <
               std::pair(points[b].time, points[b].error);
    });
    std::vector<std::size_t> best;
    for (const std::size_t i : order)
        if (best.empty() || points[i].error < points[best.back()].error) best.push_back(i);
    return best;
}

bool as_accurate(double a, double b) {
    constexpr double kTold = 0.1;
    return a * a <= b * b + kTold * kTold;
}

bool buys(double from, double to) {
    return !as_accurate(from, to) && to < 0.98 * from;
}

std::vector<std::size_t> frontier_of(const std::vector<TimedError>& points) {
    std::vector<std::size_t> found;
    for (const std::size_t i : pareto_set(points))
        if (found.empty() || buys(points[found.back()].error, points[i].error)) found.push_back(i);
    return found;
}

double Frontier::cpu_ms(std::size_t point) const {
    const auto own = points->cost();
    const auto& price = (*points)[point].price;
    return own && price ? own->cpu_ms * price->cpu_ratio.median : 0;
}

double Frontier::wall_ms(std::size_t point) const {
    const auto own = points->cost();
    const auto& price = (*points)[point].price;
    return own && price ? own->wall_ms * steady_wall_ratio(*price).median : 0;
}

std::vector<std::size_t> Frontier::drawn_rungs() const {
    std::vector<std::size_t> drawn;
    for (const Ladder& ladder : ladders)
        for (const LadderRung& rung : ladder.rungs)
            if (rung.point) drawn.push_back(*rung.point);
    std::sort(drawn.begin(), drawn.end());
    drawn.erase(std::unique(drawn.begin(), drawn.end()), drawn.end());
    return drawn;
}

std::vector<std::size_t> Frontier::untimed_rungs() const {
    std::vector<std::size_t> untimed = drawn_rungs();
    std::erase_if(untimed, [&](std::size_t i) { return (*points)[i].price.has_value(); });
    std::stable_sort(untimed.begin(), untimed.end(), [&](std::size_t a, std::size_t b) {
        return (*points)[a].first_ms < (*points)[b].first_ms;
    });
    return untimed;
}

double Frontier::least_wall_ms() const {
    double least = wall_ms(frontier.front().point);
    for (const FrontierPoint& p : frontier)
        least = std::min(least, wall_ms(p.point));
    return least;
}

namespace {

// Of the normal distribution: what its absolute value exceeds with that chance.
double exceeded_with(double chance) {
    double low = 0, high = 40;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2;
        (std::erfc(middle / std::sqrt(2.0)) > chance ? low : high) = middle;
    }
    return low;
}

} // namespace

Difference one_of(const Difference& ratio, std::size_t intervals) {
    constexpr double kMiss = 0.05;
    const double wider =
        exceeded_with(kMiss / static_cast<double>(std::max<std::size_t>(intervals, 1))) /
        exceeded_with(kMiss);
    return {ratio.median, ratio.median * std::pow(ratio.low / ratio.median, wider),
            ratio.median * std::pow(ratio.high / ratio.median, wider)};
}

std::size_t knee_of(const std::vector<TimedError>& set) {
    const auto log_time = [&](std::size_t i) { return std::log(std::max(set[i].time, 1e-3)); };
    const std::size_t last = set.size() - 1;
    const double times = log_time(last) - log_time(0), errors = set[0].error - set[last].error;
    std::size_t knee = 0;
    double most = 0;
    for (std::size_t i = 1; i < last; ++i) {
        const double later = (log_time(i) - log_time(0)) / times,
                     better = (set[0].error - set[i].error) / errors;
        if (better - later <= most) continue;
        most = better - later;
        knee = i;
    }
    return knee;
}

std::optional<std::size_t> best_buy(const std::vector<TimedError>& set, std::size_t from) {
    std::optional<std::size_t> best;
    double most = 0;
    for (std::size_t i = 0; i < set.size(); ++i) {
        const double gain = (set[from].error - set[i].error) /
                            std::max(1.0, std::log2(set[i].time / set[from].time));
        if (gain <= most) continue;
        most = gain;
        best = i;
    }
    return best;
}

std::vector<TimedError> Frontier::timed_errors() const {
    std::vector<TimedError> set;
    for (const FrontierPoint& p : frontier)
        set.push_back({cpu_ms(p.point), error(p.point)});
    return set;
}

std::optional<std::size_t> Frontier::knee() const {
    if (frontier.empty()) return std::nullopt;
    return frontier[knee_of(timed_errors())].point;
}

std::optional<std::size_t> Frontier::best_within(double wall) const {
    std::optional<std::size_t> best;
    for (const FrontierPoint& p : frontier)
        if (wall_ms(p.point) <= wall && (!best || error(p.point) < error(*best))) best = p.point;
    return best;
}

std::optional<std::size_t> Frontier::quickest_below(double codes) const {
    for (const FrontierPoint& p : frontier)
        if (error(p.point) <= codes) return p.point;
    return std::nullopt;
}

} // namespace scanout::measure
