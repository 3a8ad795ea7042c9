// The rungs that , and . choose: a place on a frontier, and the steps that wait until there is one.
#pragma once

#include "measure/known_frontier.h"

#include <cstddef>
#include <optional>

namespace scanout::app {

class RungStepper {
public:
    // One step to quicker (-1) or to more accurate (+1) rungs. False: there are none beyond, and
    // nothing changes.
    bool step(int by);
    // Steps were taken, and there is no frontier yet to take them on.
    bool wants_frontier() const { return wanted_ && !frontier_; }
    // The point from which they are taken: the rungs as asked for where the frontier has them, else
    // the most accurate ones whose frames take no longer than `wall_ms`.
    static std::size_t start(const measure::KnownFrontier& frontier, double wall_ms);
    // They are taken now.
    void put(measure::KnownFrontier frontier, double wall_ms);
    // No frontier can be had: the steps are forgotten.
    void give_up() { wanted_ = false, waiting_ = 0; }
    // Of another model.
    void clear() { *this = RungStepper(); }

    const measure::KnownFrontier* frontier() const { return frontier_ ? &*frontier_ : nullptr; }
    std::size_t at() const { return at_; } // of the frontier's points
    const measure::KnownPoint* point() const {
        return frontier_ ? &frontier_->points[at_] : nullptr;
    }

private:
    std::optional<measure::KnownFrontier> frontier_; // with a point
    std::size_t at_ = 0;
    bool wanted_ = false;
    int waiting_ = 0; // steps, summed
};

} // namespace scanout::app
