#include "raster/hidden_clusters.h"

#include <algorithm>
#include <atomic>

namespace scanout::raster {
namespace {

// A cluster that waits and is drawn after all costs more than one that did not wait. Where most
// are, fewer are tried.
constexpr std::size_t kOften = 16, kSeldom = 2048;

} // namespace

void HiddenClusters::begin_frame(std::size_t clusters) {
    if (state_.size() != clusters) {
        state_.assign(clusters, kDrawn);
        period_ = kOften;
    }
    ++frame_;
    const auto count = [&](std::uint8_t state) {
        return std::count(state_.begin(), state_.end(), state);
    };
    const auto hidden = count(kWaits), shown = count(kShown);
    if (shown > hidden) period_ = std::min(period_ * 2, kSeldom);
    if (hidden > 3 * shown) period_ = std::max(period_ / 2, kOften);
}

bool HiddenClusters::waits(std::size_t cluster) {
    std::uint8_t& state = state_[cluster];
    if (state == kShown)
        state = kDrawn;
    else if (state == kDrawn && (cluster + frame_) % period_ == 0)
        state = kWaits;
    return state == kWaits;
}

void HiddenClusters::show(std::size_t cluster) {
    std::atomic_ref(state_[cluster]).store(kShown, std::memory_order_relaxed);
}

} // namespace scanout::raster
