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
    if (state_.size() != clusters) { // as if there were no other frame
        state_.assign(clusters, kDrawn);
        period_ = kNever;
        return;
    }
    if (period_ == kNever) period_ = kOften;
    ++frame_;
    // Of those that the last frame asked about: what is out of sight says nothing.
    std::size_t hidden = 0, shown = 0;
    for (std::uint8_t& state : state_) {
        hidden += state == kWaits ? 1 : 0;
        shown += state == kShown ? 1 : 0;
        if (state == kWaits) state = kHidden;
        if (state == kShown) state = kDrawn;
    }
    if (shown > hidden) period_ = std::min(period_ * 2, kSeldom);
    if (hidden > 3 * shown) period_ = std::max(period_ / 2, kOften);
}

bool HiddenClusters::waits(std::size_t cluster) {
    std::uint8_t& state = state_[cluster];
    if (state == kDrawn && (period_ == kNever || (cluster + frame_) % period_ != 0)) return false;
    state = kWaits;
    return true;
}

void HiddenClusters::show(std::size_t cluster) {
    std::atomic_ref(state_[cluster]).store(kShown, std::memory_order_relaxed);
}

} // namespace scanout::raster
