// The middle of measured values.
#pragma once

#include <algorithm>
#include <vector>

namespace scanout::measure {

// The lower middle one of an even number; 0 for none.
inline double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace scanout::measure
