// Frame pacing: the time of the next frame, at most one a refresh, on a display that does not pace
// itself; and the number of frames a second.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace scanout::app {

class FramePacer {
public:
    using Time = std::chrono::steady_clock::time_point;

    explicit FramePacer(double refresh_hz)
        : period_(static_cast<std::int64_t>(1e9 / (refresh_hz > 1 ? refresh_hz : 60))) {}

    Time due() const { return due_; }
    Time last() const { return last_; }
    double frames_per_second() const { return frames_per_second_; } // 0: after a pause

    // A frame begins.
    void begin_frame(Time now) {
        const double passed = std::chrono::duration<double>(now - last_).count();
        frames_per_second_ = passed > 0 && passed < 0.5 ? 1 / passed : 0;
        last_ = now;
        // Half a period of slack: a late wake-up does not make every frame after it late as well.
        due_ = std::max(due_ + period_, now + period_ / 2);
    }
    // Something else was shown, such as a notice while a file is read.
    void interrupt(Time now) { last_ = now; }

private:
    std::chrono::nanoseconds period_;
    Time due_{}, last_{};
    double frames_per_second_ = 0;
};

} // namespace scanout::app
