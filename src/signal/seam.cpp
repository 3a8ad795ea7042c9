#include "signal/seam.h"

#include <algorithm>

namespace scanout::signal {

std::vector<int> cheapest_path(std::vector<std::uint32_t> cost, int across) {
    const int length = static_cast<int>(cost.size()) / across;
    const auto at = [&](int i, int k) -> std::uint32_t& {
        return cost[static_cast<std::size_t>(i) * static_cast<std::size_t>(across) +
                    static_cast<std::size_t>(k)];
    };
    const auto best_above = [&](int i, int k) { // of the row above i, beside k
        int best = std::max(k - 1, 0);
        for (int other = best + 1; other <= std::min(k + 1, across - 1); ++other)
            if (at(i - 1, other) < at(i - 1, best)) best = other;
        return best;
    };
    for (int i = 1; i < length; ++i)
        for (int k = 0; k < across; ++k)
            at(i, k) += at(i - 1, best_above(i, k));
    std::vector<int> path(static_cast<std::size_t>(length), 0);
    int k = 0;
    for (int other = 1; other < across; ++other)
        if (at(length - 1, other) < at(length - 1, k)) k = other;
    for (int i = length - 1; i >= 0; --i) {
        path[static_cast<std::size_t>(i)] = k;
        if (i > 0) k = best_above(i, k);
    }
    return path;
}

} // namespace scanout::signal
