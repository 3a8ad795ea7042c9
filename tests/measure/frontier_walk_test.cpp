// The walk along the frontier, and its ties, on made-up times and errors whose truth is known.
#include "measure/frontier_walk.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace scanout::measure {
namespace {

using Place = FrontierWalk::Place;

// A step of an axis: how many times as long a frame takes with it, and what it errs alone, codes.
struct Step {
    double time, error;
};
using Landscape = std::vector<std::vector<Step>>;

// Errors of different origin add up as squares. Where more pixels are drawn, what a pixel costs
// counts for more: that is known of no step by itself.
TimedError truth(const Landscape& axes, const Place& place) {
    double logs = 0, squares = 0.01;
    for (std::size_t axis = 0; axis < axes.size(); ++axis) {
        logs += std::log(axes[axis][place[axis]].time);
        squares += axes[axis][place[axis]].error * axes[axis][place[axis]].error;
    }
    return {std::exp(logs * (logs > 0 ? 1.1 : 0.9)), std::sqrt(squares)};
}

Landscape made_up(std::mt19937& random) {
    std::uniform_real_distribution<double> share(0, 1);
    Landscape axes(4);
    for (auto& axis : axes) {
        const std::size_t steps = 2 + random() % 4;
        const double dear = 1.2 + 3 * share(random), coarse = 8 * share(random);
        for (std::size_t i = 0; i < steps; ++i) {
            const double up = static_cast<double>(i) / static_cast<double>(steps - 1);
            axis.push_back({0.7 * std::pow(dear, up) * (1 + 0.1 * share(random)),
                            coarse * std::pow(1 - up, 1.5)});
        }
    }
    return axes;
}

constexpr double kNoise = 0.05; // of a time that is measured: standard deviation, in proportion

// What one run measures, and finds.
struct Found {
    std::map<Place, TimedError> measured;
    std::vector<Place> frontier;
    int timed = 0;
};

Found walk_of(const Landscape& axes, std::mt19937& random) {
    std::normal_distribution<double> noise(0, kNoise);
    Found run;
    const auto measure = [&](const Place& place) {
        TimedError& at = run.measured[place];
        if (at.time == 0) {
            at = truth(axes, place);
            at.time *= std::exp(noise(random));
            ++run.timed;
        }
        return at;
    };
    Place asked(axes.size(), 0);
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
        asked[axis] = axes[axis].size() / 2;
    std::vector<std::vector<double>> times(axes.size());
    for (std::size_t axis = 0; axis < axes.size(); ++axis)
        for (std::size_t step = 0; step < axes[axis].size(); ++step) {
            Place place = asked;
            place[axis] = step;
            times[axis].push_back(measure(place).time);
        }
    FrontierWalk walk(times);
    for (const auto& [place, at] : run.measured)
        walk.put(place, at);
    while (const auto look = walk.next())
        if (walk.may_gain(*look, truth(axes, look->place).error))
            walk.put(look->place, measure(look->place));
    std::vector<Place> places;
    std::vector<TimedError> at;
    for (const auto& [place, timed] : run.measured) {
        places.push_back(place);
        at.push_back(timed);
    }
    for (const std::size_t i : frontier_of(at))
        run.frontier.push_back(places[i]);
    return run;
}

// The rule of bench/frontier_runs.py: the same place, or one that errs no more by what is worth a
// word and whose time may be as short, by intervals that hold all of a frontier
// together.
int missing(const Found& a, const Found& b) {
    const auto time = [](const Found& run, const Place& place) {
        const double median = run.measured.at(place).time, wide = std::exp(1.96 * kNoise);
        return one_of({median, median / wide, median * wide}, run.frontier.size());
    };
    int count = 0;
    for (const Place& place : a.frontier) {
        const TimedError& here = a.measured.at(place);
        count += std::none_of(b.frontier.begin(), b.frontier.end(), [&](const Place& other) {
            const TimedError& there = b.measured.at(other);
            return other == place ||
                   (!buys(there.error, here.error) && time(b, other).low <= time(a, place).high);
        });
    }
    return count;
}

// Families of ten runs: all find the same but for ties in 19 of 20 of them.
TEST(FrontierWalk, TenRunsFindTheSameButForTies) {
    std::mt19937 random(1);
    int families_that_differ = 0, compared = 0, differ = 0;
    double timed = 0, all = 0;
    for (int family = 0; family < 40; ++family) {
        const Landscape axes = made_up(random);
        std::vector<Found> runs;
        for (int i = 0; i < 10; ++i)
            runs.push_back(walk_of(axes, random));
        int here = 0;
        for (const Found& a : runs)
            for (const Found& b : runs) {
                if (&a == &b) continue;
                here += missing(a, b);
                compared += static_cast<int>(a.frontier.size());
            }
        differ += here;
        families_that_differ += here > 0 ? 1 : 0;
        double places = 1;
        for (const auto& axis : axes)
            places *= static_cast<double>(axis.size());
        timed += runs[0].timed;
        all += places;
    }
    EXPECT_LE(families_that_differ, 2) << differ << " of " << compared << " comparisons";
    EXPECT_GT(compared, 10000);
    EXPECT_LT(timed, 0.5 * all); // not by measuring everything
}

// Twenty normal intervals hold together as each would alone.
TEST(FrontierTies, HoldTogether) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0, kNoise);
    constexpr int kFamilies = 2000;
    int alone = 0, together = 0;
    for (int family = 0; family < kFamilies; ++family) {
        bool all_alone = true, all_together = true;
        for (int i = 0; i < 20; ++i) {
            const double median = std::exp(noise(random)), wide = std::exp(1.96 * kNoise);
            const Difference one{median, median / wide, median * wide}, wider = one_of(one, 20);
            all_alone = all_alone && one.low <= 1 && one.high >= 1;
            all_together = all_together && wider.low <= 1 && wider.high >= 1;
        }
        alone += all_alone ? 1 : 0;
        together += all_together ? 1 : 0;
    }
    EXPECT_NEAR(alone, 0.36 * kFamilies, 0.04 * kFamilies); // 0.95 to the 20th
    EXPECT_NEAR(together, 0.95 * kFamilies, 0.02 * kFamilies);
}

// What is truly on the frontier is found, or what takes a tenth more at most.
TEST(FrontierWalk, TheTrueFrontierIsFound) {
    std::mt19937 random(2);
    int wanted = 0, missed = 0;
    for (int family = 0; family < 40; ++family) {
        const Landscape axes = made_up(random);
        const Found one = walk_of(axes, random);
        std::vector<TimedError> at;
        for (Place place(axes.size(), 0);;) {
            at.push_back(truth(axes, place));
            std::size_t axis = 0;
            while (axis < axes.size() && ++place[axis] == axes[axis].size())
                place[axis++] = 0;
            if (axis == axes.size()) break;
        }
        for (const std::size_t i : frontier_of(at)) {
            ++wanted;
            missed +=
                std::none_of(one.frontier.begin(), one.frontier.end(), [&](const Place& place) {
                    const TimedError there = truth(axes, place);
                    return !buys(there.error, at[i].error) && there.time <= 1.15 * at[i].time;
                });
        }
    }
    EXPECT_LE(missed, 0.02 * wanted) << "of " << wanted;
}

} // namespace
} // namespace scanout::measure
