// Times that can be believed on a busy machine: what one piece of work costs more than another.
// The two run in turn, ABBA, so that what drifts meets both alike, and what counts is the CPU time
// of the threads that draw. One mechanism for all who time.
//
// The interval of the median difference is that of its order statistics, which asks nothing of the
// distribution: k is the largest number for which the k-th smallest and the k-th largest of n
// differences hold the median with 95 %. A percentile bootstrap of as few covers about 92 %.
#pragma once

#include "base/jobs.h"
#include "measure/median.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace scanout::measure {

struct Cost {
    double cpu_ms = 0; // of all threads together, without waiting for each other
    double wall_ms = 0;
    std::optional<double> instructions; // in user space; nothing where they are not counted
};

// Of each quantity by itself.
Cost medians(const std::vector<Cost>& costs);

// Of what `work` does on these threads.
Cost cost_of(Jobs& jobs, const std::function<void()>& work);

// The median of differences, or of ratios, with its 95 % interval.
struct Difference {
    double median = 0, low = 0, high = 0;
    double half_width() const { return (high - low) / 2; }
    // Chance alone may have made it: it is no number to be shown.
    bool is_zero() const { return low <= 0 && high >= 0; }
    Difference operator-() const { return {-median, -high, -low}; }
};

inline constexpr std::size_t kLeastPairs = 6; // fewer have no interval of 95 %

// Of at least kLeastPairs differences.
Difference median_difference(std::vector<double> differences);

// What a costs more than b.
struct Price {
    bool by_construction = false; // both are the same work: nothing was timed
    std::size_t pairs = 0;
    Difference cpu_ms, wall_ms;
    // How many times as much: what slows the whole machine down leaves these alone.
    Difference cpu_ratio{1, 1, 1}, wall_ratio{1, 1, 1};
    std::optional<Difference> instructions;
};
// Of wall times: that of CPU times, wherever the wall times' own interval holds it. Other work on
// the machine disturbs wall times more.
Difference steady_wall_ratio(const Price& price);
Price operator-(Price price); // what b costs more than a
Price equal_by_construction();

// "1.24 ± 0.05", "0 ± 0.02".
std::string to_string(const Difference& difference);

inline constexpr std::size_t kPairsAPlace = 4;

// Runs a and b in turn until the interval of their CPU times' difference is narrow or the time is
// up.
class PairedTimer {
public:
    using Measured = std::function<Cost()>; // runs it once
    // `exchange`, where there is one, gives each the other's place: its buffers, say, of which one
    // is always a little faster, by where it lies in the caches. After kPairsAPlace pairs they
    // change, then after twice as many each time, so that both places meet a and b equally often.
    PairedTimer(Measured a, Measured b, double seconds, std::function<void()> exchange = {});
    // Runs a, b, b, a.
    void step();
    // The half width of the interval is at most a tenth of the difference, or the time is up; after
    // kLeastPairs in any case, and never before both were equally often in either place.
    bool finished() const;
    Price price() const; // once it is finished
    const std::vector<Cost>& costs_of_a() const { return a_costs_; }

private:
    void pair(bool a_first);
    Difference difference(double Cost::*of) const;
    Difference ratio(double Cost::*of) const;
    using Mean = double (*)(double, double);
    std::vector<double> balanced(std::vector<double> of_pairs, Mean mean) const;
    Measured a_, b_;
    std::function<void()> exchange_;
    double left_ms_;
    std::vector<Cost> a_costs_, b_costs_; // pair by pair
};

} // namespace scanout::measure
