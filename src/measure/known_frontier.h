// A frontier as it is remembered and used: which configurations there are, what a frame of each
// takes on this machine and what it errs; and which one of them meets what a user asks for.
#pragma once

#include "measure/frontier.h"

#include <optional>
#include <string>
#include <vector>

namespace scanout::measure {

struct KnownPoint {
    std::vector<Rung> rungs; // that differ from what was asked for
    double wall_ms = 0;      // of a steady frame, by all threads together
    double cpu_ms = 0;       // of these threads: a busy machine disturbs it little
    double error = 0;        // root mean square against the reference, codes
    std::string options() const { return options_of(rungs); }
    friend bool operator==(const KnownPoint&, const KnownPoint&) = default;
};

struct KnownFrontier {
    std::string date;               // of the measurement: year-month-day, UTC
    std::vector<KnownPoint> points; // quickest first; each errs less than the one before
    // Nothing was left out for want of time: what is not among the points cannot be had.
    bool complete = true;
    friend bool operator==(const KnownFrontier&, const KnownFrontier&) = default;
};

// Of what was timed, those that no other one beats in both wall time and error.
KnownFrontier known(const Frontier& found, std::string date);

// What to draw with, instead of what was asked for.
frame::FrameOptions with(frame::FrameOptions options, const std::vector<Rung>& rungs);

struct Limits {
    std::optional<double> wall_ms; // of a frame
    std::optional<double> error;   // codes
    bool any() const { return wall_ms || error; }
};

struct Choice {
    std::size_t point = 0;                // of the points
    bool in_time = true, accurate = true; // it meets the limit; true where there is none
    bool met() const { return in_time && accurate; }
};

// Of at least one point, in any order. Within a time: the most accurate. Below an error: the
// quickest. Both: the quickest that is accurate, where that is in time; else the most accurate in
// time. What cannot be met is missed by as little as can be; of equals the first is taken.
Choice choose(const std::vector<KnownPoint>& points, const Limits& limits);

} // namespace scanout::measure
