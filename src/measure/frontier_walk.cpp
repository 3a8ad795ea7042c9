#include "measure/frontier_walk.h"

#include <algorithm>
#include <utility>

namespace scanout::measure {

FrontierWalk::FrontierWalk(std::vector<std::vector<double>> times) : times_(std::move(times)) {}

void FrontierWalk::put(const Place& place, const TimedError& at) {
    seen_.insert(place);
    places_.push_back(place);
    at_.push_back(at);
    frontier_ = frontier_of(at_);
}

std::optional<FrontierWalk::Look> FrontierWalk::next() {
    for (const std::size_t i : frontier_)
        for (std::size_t axis = 0; axis < times_.size(); ++axis) {
            const std::size_t now = places_[i][axis];
            for (std::size_t step = 0; step < times_[axis].size(); ++step) {
                Place place = places_[i];
                place[axis] = step;
                if (!seen_.insert(place).second) continue;
                return Look{std::move(place), at_[i],
                            at_[i].time * times_[axis][step] / times_[axis][now]};
            }
        }
    return std::nullopt;
}

// A step takes more of a frame that does little else, and less of one that does more.
bool FrontierWalk::may_gain(const Look& look, double error) const {
    constexpr double kSurely = 0.7, kWorthIt = 0.95;
    if (as_accurate(look.from.error, error) && look.about > kWorthIt * look.from.time) return false;
    return std::none_of(at_.begin(), at_.end(), [&](const TimedError& other) {
        return as_accurate(other.error, error) && other.time < kSurely * look.about;
    });
}

} // namespace scanout::measure
