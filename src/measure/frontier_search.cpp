// The search for the frontier: what is measured, in which order, and when it ends. The way up from
// the cheapest configuration is in frontier_climb.cpp, what is looked at beside it is in
// frontier_walk.cpp.
#include "measure/frontier_search.h"

#include "base/stopwatch.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace scanout::measure {

Result<std::unique_ptr<FrontierSearch>>
FrontierSearch::create(const scene::Scene& scene, frame::SceneFacts facts, const scene::View& view,
                       const frame::FrameOptions& options, Jobs& jobs,
                       const image::Image& reference, FrontierOptions how) {
    Frontier found;
    TRY(found.points, Points::create(scene, std::move(facts), view, options, jobs, reference));
    return std::unique_ptr<FrontierSearch>(new FrontierSearch(std::move(found), std::move(how)));
}

FrontierSearch::FrontierSearch(Frontier found, FrontierOptions how)
    : found_(std::move(found)), how_(std::move(how)) {
    const auto& asked = how_.axes;
    for (const std::string_view axis : ladder_axes())
        if (!asked || std::find(asked->begin(), asked->end(), axis) != asked->end())
            found_.ladders.push_back(ladder_of(*found_.points, axis));
}

void FrontierSearch::step() {
    const Stopwatch watch;
    if (timed_) {
        if (found_.points->time_more(*timed_, how_.seconds_a_point)) {
            if (place_) walk_->put(*place_, timed_error(*timed_));
            place_.reset();
            timed_.reset();
        }
    } else {
        work();
    }
    spent_ms_ += watch.milliseconds();
}

void FrontierSearch::stop() {
    found_.stopped = found_.interrupted = true;
    timed_.reset();
    if (phase_ == Phase::ladders) drop_undrawn();
    if (!finished()) phase_ = Phase::end;
}

void FrontierSearch::work() {
    switch (phase_) {
    case Phase::ladders:
        return draw_rung();
    case Phase::effects:
        return price_effect();
    case Phase::rung_times:
        return time_rung();
    case Phase::climb:
        return try_step_up();
    case Phase::walk:
        return look_around();
    case Phase::end:
        return end();
    case Phase::finished:
        return;
    }
}

// So that slow rungs leave time for what comes after them, each part ends by its share of it.
bool FrontierSearch::is_late(double share) {
    const bool late = spent_ms_ > share * how_.seconds * 1000;
    found_.stopped = found_.stopped || late;
    return late;
}

void FrontierSearch::draw_rung() {
    while (next_ < found_.ladders.size()) {
        Ladder& ladder = found_.ladders[next_];
        const auto undrawn = std::find_if(ladder.rungs.begin(), ladder.rungs.end(),
                                          [](const LadderRung& r) { return !r.is_drawn(); });
        if (undrawn != ladder.rungs.end()) {
            if (is_late(1)) break;
            draw(*found_.points, ladder.axis, *undrawn);
            return;
        }
        ++next_;
        fraction_ = 0.05 * static_cast<double>(next_) / static_cast<double>(found_.ladders.size());
    }
    drop_undrawn();
    if (how_.times)
        begin_times();
    else
        phase_ = Phase::end;
}

void FrontierSearch::drop_undrawn() {
    for (Ladder& ladder : found_.ladders)
        std::erase_if(ladder.rungs, [](const LadderRung& r) { return !r.is_drawn(); });
}

void FrontierSearch::begin_times() {
    spent_ms_ = 0; // the time for drawing may be up, that for timing is not
    timed_ = 0;    // what is asked for, at least
    next_ = 0;
    phase_ = Phase::effects;
}

// Both plans have the same rows. How what is lit is shaded is a part of its light.
static bool switches_alone(const frame::FramePlan& plan, const frame::FramePlan& without,
                           std::string_view light) {
    constexpr std::string_view kOfLight[] = {"shading", "interpolate", "two_sided"};
    for (std::size_t i = 0; i < plan.decisions.size(); ++i) {
        const frame::Decision& d = plan.decisions[i];
        if (d.effect != light && d.on() != without.decisions[i].on() &&
            std::find(std::begin(kOfLight), std::end(kOfLight), d.effect) == std::end(kOfLight))
            return false;
    }
    return true;
}

// The frame with the next effect that is on, and without. A light that takes shadows or highlights
// with it is left out: their time is not its own.
void FrontierSearch::price_effect() {
    Points& points = *found_.points;
    const frame::FramePlan& plan = points[0].plan;
    while (how_.effects && next_ < plan.decisions.size() && !is_late(0.2)) {
        const frame::Decision& d = plan.decisions[next_++];
        if (!d.on() || d.choice) continue;
        frame::FrameOptions options = points.options();
        options.effects[d.effect] = false;
        const auto without = points.plan(options);
        if (!without || (without->lights.size() != plan.lights.size() &&
                         !switches_alone(plan, *without, d.effect)))
            continue;
        const Points::Saving saving = points.saving(*without, how_.seconds_a_point);
        const double pixels = static_cast<double>(options.width) * options.height;
        found_.effects.push_back(
            {d.effect, d.technique, saving.price, static_cast<double>(saving.pixels) / pixels});
        return;
    }
    begin_rung_times();
}

// First the ends of each axis, its quickest rung and its most accurate one: what the least time and
// the least error are must not depend on the time that is left. Then quick ones first: there are
// more of them on the frontier.
void FrontierSearch::begin_rung_times() {
    const Points& points = *found_.points;
    std::vector<bool> is_end(points.all().size());
    for (const Ladder& ladder : found_.ladders) {
        if (ladder.is_flat()) continue;
        std::optional<std::size_t> quickest, most_accurate;
        for (const LadderRung& rung : ladder.rungs) {
            if (!rung.point) continue;
            if (!quickest || points[*rung.point].first_ms < points[*quickest].first_ms)
                quickest = rung.point;
            if (!most_accurate || found_.error(*rung.point) < found_.error(*most_accurate))
                most_accurate = rung.point;
        }
        if (quickest) is_end[*quickest] = true;
        if (most_accurate && points.has_errors()) is_end[*most_accurate] = true;
    }
    ends_ = static_cast<std::size_t>(std::count(is_end.begin(), is_end.end(), true));
    order_.resize(points.all().size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::stable_sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(!is_end[a], points[a].first_ms) <
               std::pair(!is_end[b], points[b].first_ms);
    });
    next_ = 0;
    phase_ = Phase::rung_times;
    fraction_ = 0.15;
}

void FrontierSearch::time_rung() {
    if (next_ == order_.size() || is_late(next_ < ends_ ? 1 : 0.65)) {
        if (found_.points->has_errors()) return begin_climb();
        phase_ = Phase::end; // there is no frontier
        return;
    }
    timed_ = order_[next_++];
    fraction_ = 0.15 + 0.45 * static_cast<double>(next_) / static_cast<double>(order_.size());
}

void FrontierSearch::end() {
    if (found_.points->has_errors()) {
        if (how_.times) draw_frontier();
        look();
    }
    fraction_ = 1;
    phase_ = Phase::finished;
}

void FrontierSearch::look() {
    std::vector<std::size_t> points;
    if (how_.flip == FrontierOptions::Flip::none) return;
    for (const FrontierPoint& p : found_.frontier)
        points.push_back(p.point);
    const bool all = how_.flip == FrontierOptions::Flip::of_all && !found_.stopped;
    for (std::size_t i = 0; all && i < found_.points->all().size(); ++i)
        if ((*found_.points)[i].price) points.push_back(i); // the others are shown nowhere
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    found_.points->look_at(points);
}

Result<Frontier> frontier(const scene::Scene& scene, frame::SceneFacts facts,
                          const scene::View& view, const frame::FrameOptions& options, Jobs& jobs,
                          const image::Image& reference, const FrontierOptions& how) {
    TRY(const std::unique_ptr<FrontierSearch> search,
        FrontierSearch::create(scene, std::move(facts), view, options, jobs, reference, how));
    while (!search->finished()) {
        if (how.stop && how.stop()) search->stop();
        search->step();
        if (how.progress) how.progress(search->fraction());
    }
    return search->take();
}

} // namespace scanout::measure
