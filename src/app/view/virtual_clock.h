// Steps of 1/60 s that follow the real clock while something moves, and stand still otherwise. The
// picture depends on steps alone, so a recording can be replayed with the same frames.
#pragma once

#include "app/view/viewer.h"

#include <chrono>
#include <cstdint>
#include <optional>

namespace scanout::app {

class VirtualClock {
public:
    using Time = std::chrono::steady_clock::time_point;

    bool running() const { return start_.has_value(); }
    // From here on, `step` is now. Does nothing when it runs already.
    void run(Time now, std::int64_t step) {
        if (!start_) start_ = Start{now, step};
    }
    void stop() { start_.reset(); }

    // Only while it runs.
    std::int64_t step_at(Time now) const {
        const std::chrono::nanoseconds passed = now - start_->time;
        return start_->step + passed.count() * kStepsPerSecond / kNanosecondsPerSecond;
    }
    Time time_of(std::int64_t step) const {
        const std::int64_t steps = step - start_->step;
        return start_->time +
               std::chrono::nanoseconds((steps * kNanosecondsPerSecond + kStepsPerSecond - 1) /
                                        kStepsPerSecond);
    }

private:
    static constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
    struct Start {
        Time time;
        std::int64_t step;
    };
    std::optional<Start> start_;
};

} // namespace scanout::app
