#include "app/view/rung_stepper.h"

#include "base/check.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace scanout::app {

bool RungStepper::step(int by) {
    wanted_ = true;
    if (!frontier_) {
        waiting_ = std::clamp(waiting_ + by, -100, 100);
        return true;
    }
    const auto last = static_cast<std::int64_t>(frontier_->points.size()) - 1;
    const auto to = std::clamp<std::int64_t>(static_cast<std::int64_t>(at_) + by, 0, last);
    return static_cast<std::size_t>(to) != std::exchange(at_, static_cast<std::size_t>(to));
}

std::size_t RungStepper::start(const measure::KnownFrontier& frontier, double wall_ms) {
    CHECK(!frontier.points.empty());
    const auto own = std::find_if(frontier.points.begin(), frontier.points.end(),
                                  [](const measure::KnownPoint& p) { return p.rungs.empty(); });
    return own != frontier.points.end() ? static_cast<std::size_t>(own - frontier.points.begin())
                                        : measure::choose(frontier.points, {wall_ms, {}}).point;
}

void RungStepper::put(measure::KnownFrontier frontier, double wall_ms) {
    at_ = start(frontier, wall_ms);
    frontier_ = std::move(frontier);
    step(std::exchange(waiting_, 0));
}

} // namespace scanout::app
