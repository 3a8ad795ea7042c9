#include "measure/known_frontier.h"

#include "base/check.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace scanout::measure {

KnownFrontier known(const Frontier& found, std::string date) {
    std::vector<TimedError> at;
    for (const FrontierPoint& p : found.frontier)
        at.push_back({found.wall_ms(p.point), found.error(p.point)});
    KnownFrontier known{std::move(date), {}, !found.stopped};
    for (const std::size_t i : pareto_set(at)) {
        const std::size_t point = found.frontier[i].point;
        known.points.push_back(
            {(*found.points)[point].rungs, at[i].time, found.cpu_ms(point), at[i].error});
    }
    return known;
}

frame::FrameOptions with(frame::FrameOptions options, const std::vector<Rung>& rungs) {
    for (const Rung& rung : rungs)
        CHECK(frame::ask(options, rung.axis, rung.technique));
    return options;
}

Choice choose(const std::vector<KnownPoint>& points, const Limits& limits) {
    CHECK(!points.empty());
    const auto in_time = [&](const KnownPoint& p) {
        return !limits.wall_ms || p.wall_ms <= *limits.wall_ms;
    };
    const auto accurate = [&](const KnownPoint& p) {
        return !limits.error || p.error <= *limits.error;
    };
    // What is missed comes before what is gained.
    const auto place = [&](const KnownPoint& p) {
        const bool quickest = !in_time(p) || (limits.error && accurate(p));
        return quickest ? std::tuple(!in_time(p), !accurate(p) && in_time(p), p.wall_ms, p.error)
                        : std::tuple(!in_time(p), !accurate(p), p.error, p.wall_ms);
    };
    const auto best = std::min_element(
        points.begin(), points.end(),
        [&](const KnownPoint& a, const KnownPoint& b) { return place(a) < place(b); });
    return {static_cast<std::size_t>(best - points.begin()), in_time(*best), accurate(*best)};
}

} // namespace scanout::measure
