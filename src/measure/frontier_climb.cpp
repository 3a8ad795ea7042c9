// The search for the frontier: whole configurations, from the cheapest one upwards, and which of
// all that was measured are on the frontier.
#include "measure/frontier_search.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace scanout::measure {
namespace {

bool overlap(const Difference& a, const Difference& b) {
    return a.low <= b.high && b.low <= a.high;
}

} // namespace

// The first of two rungs is as accurate, and about as quick: a gain of less than a twentieth is
// found in one run and missed in the next, and each rung that is left makes whole configurations to
// measure. (Where a tenth was asked for, a rung whose gain beside other rungs is larger went with
// it.)
bool FrontierSearch::as_good(const Step& s, const Step& r) const {
    constexpr double kAsQuick = 1.05;
    return found_.cpu_ms(s.point) <= kAsQuick * found_.cpu_ms(r.point) &&
           as_accurate(found_.error(s.point), found_.error(r.point));
}
// Of two that are as good as each other: what is asked for, else the higher rung.
bool FrontierSearch::replaces(const Step& s, const Step& r) const {
    return as_good(s, r) && (!as_good(r, s) || s.point == 0 || (r.point != 0 && &s > &r));
}

// The rungs of an axis that no other one can stand for, quickest first. What is asked for and the
// top rung stay in any case, the top one last: beside a large error of another axis a poor rung may
// err less than an exact one by chance, and once that axis is exact, too, only this one is left to
// gain from.
FrontierSearch::Way FrontierSearch::way_up(const Ladder& ladder) const {
    std::vector<Step> steps;
    for (const LadderRung& rung : ladder.rungs) {
        if (!rung.point || !(*found_.points)[*rung.point].price) continue;
        std::erase_if(steps, [&](const Step& s) { return s.point == *rung.point; });
        steps.push_back({rung.technique, *rung.point});
    }
    Way way{ladder.axis, {}, 0};
    if (steps.empty()) return way;
    const Step& top = steps.back();
    std::copy_if(steps.begin(), steps.end() - 1, std::back_inserter(way.steps), [&](const Step& r) {
        return r.point == 0 || std::none_of(steps.begin(), steps.end(), [&](const Step& s) {
                   return &s != &r && replaces(s, r);
               });
    });
    std::stable_sort(way.steps.begin(), way.steps.end(), [&](const Step& a, const Step& b) {
        return found_.cpu_ms(a.point) < found_.cpu_ms(b.point);
    });
    way.steps.push_back(top);
    return way;
}

// Leaves out what is asked for anyway, or changes nothing.
std::vector<Rung> FrontierSearch::shortest(std::vector<Rung> rungs) const {
    const auto plan_of = [&](const std::vector<Rung>& some) {
        frame::FrameOptions options = found_.points->options();
        for (const Rung& rung : some)
            frame::ask(options, rung.axis, rung.technique);
        return found_.points->plan(options);
    };
    const auto whole = plan_of(rungs);
    for (std::size_t i = 0; whole && i < rungs.size();) {
        std::vector<Rung> fewer = rungs;
        fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
        const auto plan = plan_of(fewer);
        if (plan && frame::draws_alike(*plan, *whole))
            rungs = std::move(fewer);
        else
            ++i;
    }
    return rungs;
}

std::optional<std::size_t> FrontierSearch::drawn(const FrontierWalk::Place& place) {
    std::vector<Rung> rungs;
    for (std::size_t w = 0; w < ways_.size(); ++w)
        rungs.push_back({ways_[w].axis, ways_[w].steps[place[w]].technique});
    const auto point = found_.points->at(shortest(std::move(rungs)));
    return point ? std::optional(*point) : std::nullopt;
}

FrontierWalk::Place FrontierSearch::place() const {
    FrontierWalk::Place here;
    for (const Way& way : ways_)
        here.push_back(way.at);
    return here;
}

// From the cheapest rungs of all axes upwards.
void FrontierSearch::begin_climb() {
    for (const Ladder& ladder : found_.ladders) {
        if (ladder.is_flat()) continue;
        Way way = way_up(ladder);
        if (way.steps.empty()) continue;
        all_steps_ += way.steps.size();
        ways_.push_back(std::move(way));
    }
    begin_walk();
    const std::optional<std::size_t> cheapest = drawn(place());
    phase_ = cheapest ? Phase::climb : Phase::walk;
    if (!cheapest) return;
    now_ = *cheapest;
    time(place(), now_);
    list_steps_up();
}

void FrontierSearch::list_steps_up() {
    untried_.clear();
    tried_.clear();
    for (std::size_t w = ways_.size(); w-- > 0;)
        for (std::size_t at = ways_[w].steps.size(); --at > ways_[w].at;)
            untried_.push_back({w, at, 0});
}

// The next step is that rung of any axis which, as part of the whole, lowers the error most for its
// time.
void FrontierSearch::try_step_up() {
    if (is_late(1)) {
        phase_ = Phase::end;
        return;
    }
    if (untried_.empty()) return take_best_step();
    Candidate candidate = untried_.back();
    untried_.pop_back();
    FrontierWalk::Place there = place();
    there[candidate.way] = candidate.at;
    const std::optional<std::size_t> point = drawn(there);
    if (!point || !buys(found_.error(now_), found_.error(*point))) return;
    candidate.point = *point;
    time(there, *point);
    tried_.push_back(candidate);
}

void FrontierSearch::take_best_step() {
    const Candidate* best = nullptr;
    for (const Candidate& candidate : tried_)
        if (gain_of(now_, candidate.point) > (best != nullptr ? gain_of(now_, best->point) : 0))
            best = &candidate;
    if (best == nullptr) {
        phase_ = Phase::walk;
        return;
    }
    ways_[best->way].at = best->at;
    now_ = best->point;
    ++steps_taken_;
    fraction_ = 0.6 + 0.3 * static_cast<double>(steps_taken_) / static_cast<double>(all_steps_);
    list_steps_up();
}

// What the ladders have measured lies on the axes' own ways.
void FrontierSearch::begin_walk() {
    std::vector<std::vector<double>> times;
    FrontierWalk::Place asked;
    for (const Way& way : ways_) {
        times.emplace_back();
        for (const Step& step : way.steps)
            times.back().push_back((*found_.points)[step.point].price->cpu_ratio.median);
        const auto own = std::find_if(way.steps.begin(), way.steps.end(),
                                      [](const Step& s) { return s.point == 0; });
        if (own == way.steps.end()) continue; // too slow to be timed
        asked.push_back(static_cast<std::size_t>(own - way.steps.begin()));
    }
    walk_.emplace(std::move(times));
    if (asked.size() != ways_.size()) return;
    for (std::size_t w = 0; w < ways_.size(); ++w)
        for (std::size_t at = 0; at < ways_[w].steps.size(); ++at) {
            FrontierWalk::Place place = asked;
            place[w] = at;
            walk_->put(place, timed_error(ways_[w].steps[at].point));
        }
}

TimedError FrontierSearch::timed_error(std::size_t point) const {
    return {(*found_.points)[point].price->cpu_ratio.median, found_.error(point)};
}

void FrontierSearch::time(const FrontierWalk::Place& place, std::size_t point) {
    timed_ = point;
    place_ = place;
}

void FrontierSearch::look_around() {
    if (is_late(1)) {
        phase_ = Phase::end;
        return;
    }
    const std::optional<FrontierWalk::Look> look = walk_->next();
    if (!look) {
        phase_ = Phase::end;
        return;
    }
    const std::optional<std::size_t> point = drawn(look->place);
    if (point && ((*found_.points)[*point].price || walk_->may_gain(*look, found_.error(*point))))
        time(look->place, *point);
}

// Codes for a millisecond; what costs nothing comes first.
double FrontierSearch::gain_of(std::size_t from, std::size_t to) const {
    const double least = 0.001 * found_.cpu_ms(from);
    return (found_.error(from) - found_.error(to)) /
           std::max(found_.cpu_ms(to) - found_.cpu_ms(from), least);
}

// Neither its time nor its error can be told from what is asked for anyway, which stands for
// it.
bool FrontierSearch::is_as_asked(std::size_t i) const {
    const Difference& ratio = (*found_.points)[i].price->cpu_ratio;
    return i != 0 && ratio.low <= 1 && ratio.high >= 1 &&
           as_accurate(found_.error(0), found_.error(i));
}

void FrontierSearch::draw_frontier() {
    if (!found_.points->cost()) return;
    std::vector<std::size_t> timed;
    std::vector<TimedError> at;
    for (std::size_t i = 0; i < found_.points->all().size(); ++i) {
        if (!(*found_.points)[i].price || is_as_asked(i)) continue;
        timed.push_back(i);
        at.push_back({found_.cpu_ms(i), found_.error(i)});
    }
    const std::vector<std::size_t> set = frontier_of(at);
    for (const std::size_t i : set) {
        const Difference time = one_of((*found_.points)[timed[i]].price->cpu_ratio, set.size());
        if (!found_.frontier.empty())
            found_.frontier.back().ties_with_next = overlap(found_.frontier.back().time, time);
        found_.frontier.push_back({timed[i], time, false});
    }
}

} // namespace scanout::measure
