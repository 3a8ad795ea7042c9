// Where the search looks for the frontier once it has found a way up: beside each configuration of
// the frontier, with the technique of one axis changed, until none of these is on the frontier
// itself (Pareto local search, Paquete et al. 2004). A way up, which chance turns here or there,
// passes by much of it; what is found from all sides depends on no such turn.
#pragma once

#include "measure/frontier.h"

#include <cstddef>
#include <optional>
#include <set>
#include <vector>

namespace scanout::measure {

class FrontierWalk {
public:
    using Place = std::vector<std::size_t>; // on each axis the step

    // times: what each step of each axis takes where the other axes are as asked for.
    explicit FrontierWalk(std::vector<std::vector<double>> times);

    // What was measured. Places that draw alike are the same.
    void put(const Place& place, const TimedError& at);
    // A place that was not looked at yet, beside the quickest of the frontier that has one.
    struct Look {
        Place place;
        TimedError from;  // of the place beside it
        double about = 0; // the time that it takes, in proportion to what its step takes elsewhere
    };
    std::optional<Look> next();
    // Nothing that was measured is as accurate and surely as quick.
    bool may_gain(const Look& look, double error) const;

private:
    std::vector<std::vector<double>> times_;
    std::vector<Place> places_; // measured
    std::vector<TimedError> at_;
    std::vector<std::size_t> frontier_; // of these
    std::set<Place> seen_;
};

} // namespace scanout::measure
