#include "app/frontier/chart_axes.h"

#include <algorithm>
#include <cmath>

namespace scanout::app {

LogAxis::LogAxis(double low, double high) {
    std::vector<double> all;
    for (int power = -4; power <= 6; ++power)
        for (const double digit : {1.0, 2.0, 5.0})
            all.push_back(digit * std::pow(10.0, power));
    auto first = std::upper_bound(all.begin(), all.end(), low);
    auto last = std::lower_bound(all.begin(), all.end(), high);
    if (first != all.begin()) --first;
    if (last == all.end()) --last;
    if (last <= first) last = first + 1;
    ticks_.assign(first, last + 1);
}

double LogAxis::place(double value) const {
    const double from = std::log(ticks_.front()), to = std::log(ticks_.back());
    return std::clamp((std::log(std::max(value, 1e-9)) - from) / (to - from), 0.0, 1.0);
}

ChartAxes axes_of(const Chart& chart) {
    double quick = 1e9, slow = kLeastTime, best = chart.noise, worst = kLeastError;
    for (const ChartPoint& p : chart.points) {
        quick = std::min(quick, p.time);
        slow = std::max(slow, p.time);
        best = std::min(best, p.error);
        worst = std::max(worst, p.error);
    }
    return {{std::max(quick * 0.9, kLeastTime), slow * 1.1},
            {std::max(best * 0.7, kLeastError), worst * 1.1}};
}

} // namespace scanout::app
