#include "measure/paired.h"

#include "base/check.h"
#include "base/stopwatch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace scanout::measure {
namespace {

constexpr std::size_t kMostPairs = 400;
constexpr double kNarrow = 0.1; // half width of the interval, of the difference

// The largest k for which at most 2.5 % of n tosses show heads fewer than k times: then the k-th
// smallest of n differences is above the median with that probability at most. 0 for n < 6.
std::size_t rank_of_bound(std::size_t n) {
    double log_chance = -static_cast<double>(n) * std::log(2.0); // of i heads
    double fewer = 0;
    for (std::size_t i = 0; i < n; ++i) {
        fewer += std::exp(log_chance);
        if (fewer > 0.025) return i;
        log_chance += std::log(static_cast<double>(n - i)) - std::log(static_cast<double>(i + 1));
    }
    return n;
}

} // namespace

Cost medians(const std::vector<Cost>& costs) {
    std::vector<double> cpu, wall, instructions;
    for (const Cost& cost : costs) {
        cpu.push_back(cost.cpu_ms);
        wall.push_back(cost.wall_ms);
        if (cost.instructions) instructions.push_back(*cost.instructions);
    }
    Cost middle{median(cpu), median(wall), {}};
    if (!instructions.empty()) middle.instructions = median(instructions);
    return middle;
}

Cost cost_of(Jobs& jobs, const std::function<void()>& work) {
    jobs.start_counting();
    const Stopwatch watch;
    work();
    const double wall_ms = watch.milliseconds();
    const Work done = jobs.stop_counting();
    Cost cost{done.cpu_ms(), wall_ms, {}};
    if (counts_instructions()) cost.instructions = static_cast<double>(done.instructions);
    return cost;
}

Difference median_difference(std::vector<double> differences) {
    CHECK(differences.size() >= kLeastPairs);
    std::sort(differences.begin(), differences.end());
    const std::size_t rank = rank_of_bound(differences.size());
    return {median(differences), differences[rank - 1], differences[differences.size() - rank]};
}

static Difference inverse(const Difference& ratio) {
    return {1 / ratio.median, 1 / ratio.high, 1 / ratio.low};
}

Difference steady_wall_ratio(const Price& price) {
    Difference wall = price.wall_ratio;
    const double cpu = price.cpu_ratio.median;
    if (wall.low <= cpu && cpu <= wall.high) wall.median = cpu;
    return wall;
}

Price operator-(Price price) {
    price.cpu_ms = -price.cpu_ms;
    price.wall_ms = -price.wall_ms;
    price.cpu_ratio = inverse(price.cpu_ratio);
    price.wall_ratio = inverse(price.wall_ratio);
    if (price.instructions) price.instructions = -*price.instructions;
    return price;
}

Price equal_by_construction() {
    Price price;
    price.by_construction = true;
    return price;
}

std::string to_string(const Difference& d) {
    if (d.is_zero()) return fmt::format("0 ± {:.2f}", std::max({-d.low, d.high, 0.01}));
    const double half = std::max(d.half_width(), 0.005);
    return fmt::format("{:.2f} ± {:.2f}", d.median, half);
}

PairedTimer::PairedTimer(Measured a, Measured b, double seconds, std::function<void()> exchange)
    : a_(std::move(a)), b_(std::move(b)), exchange_(std::move(exchange)), left_ms_(seconds * 1000) {
}

void PairedTimer::pair(bool a_first) {
    if (a_first) a_costs_.push_back(a_());
    b_costs_.push_back(b_());
    if (!a_first) a_costs_.push_back(a_());
    left_ms_ -= a_costs_.back().wall_ms + b_costs_.back().wall_ms;
}

void PairedTimer::step() {
    pair(true);
    pair(false);
    if (!exchange_ || a_costs_.size() % (2 * kPairsAPlace) != kPairsAPlace) return;
    const Stopwatch watch;
    exchange_();
    left_ms_ -= watch.milliseconds();
}

bool PairedTimer::finished() const {
    if (a_costs_.size() < kLeastPairs) return false;
    if (exchange_ && a_costs_.size() % (2 * kPairsAPlace) != 0) return false;
    if (left_ms_ <= 0 || a_costs_.size() >= kMostPairs) return true;
    const Difference cpu = difference(&Cost::cpu_ms);
    return cpu.half_width() <= kNarrow * std::abs(cpu.median);
}

// Where the two changed places, the mean of a pair in one and a pair in the other: what the places
// make cancels. The few pairs of the first change stand by themselves, since an interval takes
// kLeastPairs values: half of them are as much too high as the others are too low, so that their
// interval holds the median more often still.
std::vector<double> PairedTimer::balanced(std::vector<double> of_pairs, Mean mean) const {
    if (!exchange_ || of_pairs.size() < 2 * kLeastPairs) return of_pairs;
    std::vector<double> first, second;
    for (std::size_t i = 0; i < of_pairs.size(); ++i) {
        const bool exchanged = (i + kPairsAPlace) / (2 * kPairsAPlace) % 2 == 1;
        (exchanged ? second : first).push_back(of_pairs[i]);
    }
    for (std::size_t i = 0; i < first.size(); ++i)
        first[i] = mean(first[i], second[i]);
    return first;
}

// What a place adds cancels in the one mean, its factor in the other.
static double arithmetic_mean(double a, double b) {
    return (a + b) / 2;
}
static double geometric_mean(double a, double b) {
    return std::sqrt(a * b);
}

Difference PairedTimer::difference(double Cost::*of) const {
    std::vector<double> differences;
    for (std::size_t i = 0; i < a_costs_.size(); ++i)
        differences.push_back(a_costs_[i].*of - b_costs_[i].*of);
    return median_difference(balanced(std::move(differences), arithmetic_mean));
}

Difference PairedTimer::ratio(double Cost::*of) const {
    constexpr double kLeast = 1e-6; // ms: no clock is finer
    std::vector<double> ratios;
    for (std::size_t i = 0; i < a_costs_.size(); ++i)
        ratios.push_back(std::max(a_costs_[i].*of, kLeast) / std::max(b_costs_[i].*of, kLeast));
    return median_difference(balanced(std::move(ratios), geometric_mean));
}

Price PairedTimer::price() const {
    Price price;
    price.pairs = a_costs_.size();
    price.cpu_ms = difference(&Cost::cpu_ms);
    price.wall_ms = difference(&Cost::wall_ms);
    price.cpu_ratio = ratio(&Cost::cpu_ms);
    price.wall_ratio = ratio(&Cost::wall_ms);
    std::vector<double> instructions;
    for (std::size_t i = 0; i < a_costs_.size(); ++i)
        if (a_costs_[i].instructions && b_costs_[i].instructions)
            instructions.push_back(*a_costs_[i].instructions - *b_costs_[i].instructions);
    if (instructions.size() == a_costs_.size())
        price.instructions = median_difference(balanced(std::move(instructions), arithmetic_mean));
    return price;
}

} // namespace scanout::measure
