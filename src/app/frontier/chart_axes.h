// The logarithmic axes of a chart.
#pragma once

#include "app/frontier/chart.h"

#include <vector>

namespace scanout::app {

// From one power of ten's 1, 2 or 5 to another, about the values between.
class LogAxis {
public:
    LogAxis(double low, double high);
    const std::vector<double>& ticks() const { return ticks_; }
    // 0 at the first tick, 1 at the last; clamped.
    double place(double value) const;

private:
    std::vector<double> ticks_;
};

struct ChartAxes {
    LogAxis time, error;
};
ChartAxes axes_of(const Chart& chart);

// What logarithms are taken of at least: ms, codes.
inline constexpr double kLeastTime = 0.001, kLeastError = 0.01;

} // namespace scanout::app
