// What accuracy costs: the ladders of all axes, the price of each effect, and the frontier of whole
// configurations (Pareto's set): those that no other one beats both in time and in accuracy, each
// more accurate than the one before by a tenth of a code, as squares add up, and by a fiftieth.
// Every point on it was drawn, compared and timed as a whole.
//
// Errors are root mean squares of sRGB codes; times are CPU times, which a busy machine disturbs
// little (paired.h). Wall times are kept beside them.
#pragma once

#include "measure/ladder.h"
#include "measure/points.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace scanout::measure {

struct TimedError {
    double time = 0, error = 0;
};

struct EffectPrice {
    std::string effect, technique;
    Price price;              // of a frame with it over one without
    double changed_share = 0; // of the pixels
};

struct FrontierPoint {
    std::size_t point = 0; // of Points
    // Its CPU time over that of the picture as asked for, in an interval that all points of the
    // frontier hold together with 95 %: what each of twenty holds by itself, one of them misses.
    Difference time;
    // Its time and that of the next one cannot be told apart: these intervals overlap.
    bool ties_with_next = false;
};

struct Frontier {
    std::unique_ptr<Points> points;
    std::vector<Ladder> ladders;
    std::vector<EffectPrice> effects;    // those that are on
    std::vector<FrontierPoint> frontier; // quickest first; none where times or errors are missing
    bool stopped = false;                // before all was measured, or slow rungs were left out
    bool interrupted = false;            // by the user, not by the time

    // Of a frame: the median of the picture as asked for, times how often as much the point takes.
    double cpu_ms(std::size_t point) const;
    double wall_ms(std::size_t point) const;
    double error(std::size_t point) const { return (*points)[point].error.rmse_codes; }
    // Of the rungs of all ladders, each once: those that were drawn, and of these the ones without
    // a time, quickest first as far as their first frames tell.
    std::vector<std::size_t> drawn_rungs() const;
    std::vector<std::size_t> untimed_rungs() const;
    // Of the frontier, whose order is that of CPU times; it has a point.
    double least_wall_ms() const;
    std::vector<TimedError> timed_errors() const; // of the frontier, by CPU time
    // Of Points; nothing of an empty frontier.
    std::optional<std::size_t> knee() const;
    // The most accurate point of the frontier whose frame takes no more than so many milliseconds
    // of wall time, and the quickest one that errs no more than so many codes.
    std::optional<std::size_t> best_within(double wall_ms) const;
    std::optional<std::size_t> quickest_below(double codes) const;
};

struct FrontierOptions {
    enum class Flip { none, of_frontier, of_all };
    std::optional<std::vector<std::string>> axes; // of ladder_axes(); nothing: all
    bool times = true;                            // without: ladders alone, errors alone
    double seconds = 1e9;          // of measuring; what is not measured by then is left out
    double seconds_a_point = 0.25; // of its frames; 2 kPairsAPlace pairs in any case
    bool effects = true;           // their prices
    Flip flip = Flip::of_all;
    std::function<void(double fraction)> progress;
    std::function<bool()> stop; // asked often: true ends the measurement, and what there is counts
};

// Without a reference (an empty picture) times alone. Fails like frame::plan.
Result<Frontier> frontier(const scene::Scene& scene, frame::SceneFacts facts,
                          const scene::View& view, const frame::FrameOptions& options, Jobs& jobs,
                          const image::Image& reference, const FrontierOptions& how);

// Of points (time, error) those that no other one beats in both, by time; of equal ones the first.
std::vector<std::size_t> pareto_set(const std::vector<TimedError>& points);
// Errors of whole pictures, codes: a is no more than b by a tenth, where they add up as squares.
// Less is not worth a word.
bool as_accurate(double a, double b);
// That an error falls so far is enough to be worth a step: by a fiftieth at least.
bool buys(double from, double to);
// Of a Pareto set those that buy something over the one before.
std::vector<std::size_t> frontier_of(const std::vector<TimedError>& points);
// The interval of a ratio, as one of so many that are to hold together: each with 5 % of a chance
// to miss, divided by their number (Dunn 1961). How much wider that is the normal distribution
// says, to which medians come close; so few values as a time is measured by have no ranks for it.
Difference one_of(const Difference& ratio, std::size_t intervals);
// Of such a set, by time: the one farthest below the line from the first to the last, where the
// time's axis is logarithmic and the error's is not: more of the errors' range is gained there than
// of the times' is spent. The first where none is below.
std::size_t knee_of(const std::vector<TimedError>& set);
// The one that gains most over `from` for each doubling of its time, of which there is one at
// least; nothing where none errs less.
std::optional<std::size_t> best_buy(const std::vector<TimedError>& set, std::size_t from);

} // namespace scanout::measure
